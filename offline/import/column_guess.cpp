// SPDX-License-Identifier: Apache-2.0
#include "import/column_guess.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "cell/column_names.hpp"
#include "cell/units.hpp"
#include "import/expanded.hpp"
#include "import/heading.hpp"
#include "import/joint_names.hpp"
#include "import/map_option.hpp"
#include "import/numbered.hpp"
#include "import/unit_words.hpp"
#include "program/problem.hpp"

namespace plumb::offline {
namespace {

bool needs_unit(const std::string& name) {
  return !name.empty() && !allowed_quantities(name).empty();
}

[[noreturn]] void refuse(const char* code, std::string message, std::string help) {
  throw Failure(Exit::kUsage,
                {.code = code, .message = std::move(message), .help = std::move(help)});
}

/// Refuses a unit of another quantity: a coordinate in degrees, a payload in millimetres.
void refuse_other_kind(const std::string& from, const Heading& heading) {
  const auto allowed = allowed_quantities(heading.name);
  const Quantity given = unit_of(heading.unit)->quantity;
  if (allowed.empty() || std::find(allowed.begin(), allowed.end(), given) != allowed.end()) return;
  std::vector<std::string> kinds;
  for (const Quantity q : allowed) kinds.emplace_back(kind_name(q));
  refuse("E-IMPORT-MAP",
         fmt::format("--map: {} is {}, but {} measures {}", heading.name, fmt::join(kinds, " or "),
                     heading.unit, kind_name(given)),
         map_option({fmt::format("{}={}_{}", from, heading.name, usual_unit(heading.name))}));
}

/// Applies the new name that --map gives: "x_mm"; "u95x_um" for an expanded uncertainty; "-" leaves
/// the column out.
void take_name(const std::string& from, std::string to, ColumnPlan& plan) {
  plan.wished = true;
  plan.lacks_unit = false;
  plan.foreign.clear();
  plan.divisor = 1.0;
  plan.named = {};
  plan.said.clear();
  if (to == "-") {
    plan.name.clear();
    return;
  }
  if (to.find('|') != to.npos)
    refuse("E-IMPORT-MAP", fmt::format("--map: '{}' leaves a choice", to),
           "keep one of the units that '|' divides, as in x_mm");
  if (unitless_quantity(to)) {
    plan.name = to;
    plan.unit.clear();
    return;
  }
  const bool expanded = to.size() > 5 && to.starts_with("u95") && to[4] == '_';
  if (expanded) {
    to = "s" + to.substr(3);
    plan.divisor = 2.0;
    plan.said = "u95";
  }
  const Heading heading = split_heading(to);
  if (heading.unit.empty() || !unit_of(heading.unit))
    refuse("E-IMPORT-MAP", fmt::format("--map: '{}' has no unit plumb knows", to),
           foreign_unit(heading.unit) != nullptr
               ? fmt::format("convert the numbers first: {}", foreign_unit(heading.unit)->equals)
               : fmt::format("say it, as in --map \"{}={}_{}\"", from, heading.name,
                             usual_unit(heading.name)));
  refuse_other_kind(from, heading);
  plan.name = heading.name;
  plan.unit = heading.unit;
}

void apply_wish(const ColumnWish& wish, const std::vector<std::string>& elsewhere,
                std::vector<ColumnPlan>& plans) {
  std::vector<std::string> names;
  for (const auto& plan : plans) names.push_back(plan.from);
  const auto at = std::find(names.begin(), names.end(), wish.from);
  if (at == names.end()) {
    if (std::find(elsewhere.begin(), elsewhere.end(), wish.from) != elsewhere.end()) return;
    names.insert(names.end(), elsewhere.begin(), elsewhere.end());
    const auto guess = did_you_mean(wish.from, names);
    refuse("E-IMPORT-MAP",
           fmt::format("--map: {} column '{}'",
                       elsewhere.empty() ? "the file has no" : "neither file has a", wish.from),
           guess ? fmt::format("did you mean '{}'?", *guess)
                 : fmt::format("the columns: {}", fmt::join(names, ", ")));
  }
  ColumnPlan& plan = plans[static_cast<std::size_t>(at - names.begin())];
  if (plan.wished)
    refuse("E-IMPORT-MAP", fmt::format("--map: column '{}' is named twice", wish.from),
           "say once what it is");
  take_name(wish.from, wish.to, plan);
}

void refuse_doubles(const std::vector<ColumnPlan>& plans) {
  std::map<std::string, std::string> seen;
  for (const auto& plan : plans) {
    if (plan.name.empty()) continue;
    const auto [at, is_new] = seen.emplace(plan.name, plan.from);
    if (!is_new)
      refuse("E-IMPORT-TWICE",
             fmt::format("columns '{}' and '{}' would both become {}", at->second, plan.from,
                         plan.name),
             fmt::format("leave one out: --map \"{}=-\"", plan.from));
  }
}

/// A column in plumb's own style, "q1_deg", is taken at its word.
bool in_own_style(const std::string& header, ColumnPlan& out) {
  if (unitless_quantity(header)) {
    out.name = header;
    return true;
  }
  const Heading own = split_heading(header);
  if (own.unit.empty() || !unit_of(own.unit)) return false;
  out.name = own.name;
  out.unit = own.unit;
  const NamedColumn named = named_column(own.name);
  if (named.name.empty() && !named.uncertain) return true;
  out.named = named;
  if (allowed_quantities(own.name).empty()) out.name = named.name;
  return true;
}

}  // namespace

ColumnPlan guess_column(const std::string& header, const std::string& unit_row) {
  ColumnPlan out{.from = header};
  const auto expanded = expanded_uncertainty(header);
  const std::string heading = expanded ? expanded->rest : header;
  if (!in_own_style(heading, out)) {
    const WrittenHeading written = read_heading(heading);
    const NamedColumn meant = named_column(written.name);
    const bool foreign = written.unit.empty() && (needs_unit(meant.name) || meant.name == "time");
    const bool whole = !written.foreign.empty() && !foreign;
    out.named = whole ? named_column(heading) : meant;
    out.name = out.named.name;
    out.unit = !written.unit.empty() ? written.unit : known_unit(unit_row);
    if (foreign)
      out.foreign = !written.foreign.empty() ? written.foreign
                    : out.unit.empty()       ? unit_of_others(unit_row)
                                             : "";
  }
  if (expanded) {
    // An uncertainty is used only if it is that of one coordinate of the measured point.
    const bool of_axis = out.name.size() == 2 && out.name[0] == 's' && out.name != "s";
    out.named.uncertain = !of_axis;
    if (of_axis) out.divisor = expanded->factor, out.said = expanded->said;
    if (!of_axis) out.name.clear();
  } else if (out.named.uncertain) {
    out.name.clear();
  }
  out.uncertain_unit = out.named.uncertain ? out.unit : "";
  if (out.name.empty() || (unitless_quantity(out.name) && out.name != "time")) out.unit.clear();
  out.lacks_unit = needs_unit(out.name) && out.unit.empty() && out.foreign.empty();
  return out;
}

std::vector<ColumnWish> wishes_of(const std::vector<std::string>& texts,
                                  const std::vector<std::string>& columns) {
  std::vector<ColumnWish> out;
  for (const auto& text : texts) {
    std::string_view rest = text;
    while (!rest.empty()) {
      // A column name may contain commas and equals signs, so the known names are tried first.
      std::size_t length = 0;
      for (const auto& column : columns)
        if (rest.starts_with(column) && rest.substr(column.size()).starts_with('='))
          length = std::max(length, column.size());
      if (length == 0) length = std::min(rest.find('='), rest.size());
      const auto behind = rest.substr(std::min(length + 1, rest.size()));
      const auto end = std::min(behind.find(','), behind.size());
      if (length == 0 || end == 0)
        refuse("E-IMPORT-MAP", fmt::format("--map '{}' is not OLD=NEW_UNIT", text),
               "--map \"Goal x=nx_m\", or --map note=- to leave a column out");
      out.push_back({std::string(rest.substr(0, length)), std::string(behind.substr(0, end))});
      rest = behind.substr(std::min(end + 1, behind.size()));
    }
  }
  return out;
}

std::vector<ColumnPlan> plan_columns(const std::vector<std::string>& header,
                                     const std::vector<std::string>& units,
                                     const std::vector<ColumnContent>& contents,
                                     const std::vector<ColumnWish>& wishes,
                                     const std::vector<std::string>& elsewhere,
                                     const std::vector<std::string>& joints,
                                     std::vector<Problem>& remarks) {
  std::vector<ColumnPlan> out;
  for (std::size_t i = 0; i < header.size(); ++i)
    out.push_back(guess_column(header[i], i < units.size() ? units[i] : ""));
  for (const auto& wish : wishes) apply_wish(wish, elsewhere, out);
  name_joints(joints, units, out, remarks);
  decide_numbered(contents, out, remarks);
  // If --map and a guess give the same name, the guess is dropped.
  for (const auto& wished : out)
    for (auto& other : out)
      if (wished.wished && !other.wished && !wished.name.empty() && other.name == wished.name)
        other.name.clear();
  refuse_doubles(out);
  return out;
}

}  // namespace plumb::offline
