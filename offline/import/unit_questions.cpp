// SPDX-License-Identifier: Apache-2.0
#include "import/unit_questions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "cell/column_names.hpp"
#include "cell/units.hpp"
#include "import/heading.hpp"
#include "import/map_option.hpp"
#include "import/unit_words.hpp"

namespace plumb::offline {
namespace {

/// Columns of one kind have one unit: q1 to q6, x to z.
std::string kind_of(const std::string& name) {
  if (joint_number(name, "q") > 0) return "q";
  if (joint_number(name, "qc") > 0) return "qc";
  if (joint_number(name, "travel_j") > 0) return "travel";
  const bool axis = !name.empty() && name.back() >= 'x' && name.back() <= 'z';
  return axis ? name.substr(0, name.size() - 1) + "x" : name;
}

/// The name of the column in a proposed --map. An expanded uncertainty is named as one, so that
/// pasting the proposal changes no number.
std::string map_name(const ColumnPlan& plan) {
  return plan.divisor != 1.0 ? "u95" + plan.name.substr(1) : plan.name;
}

/// The position of a name as a whole word: 'x' is not found at the end of "index".
std::size_t place_of(const std::string& line, const std::string& name) {
  const auto part_of_word = [&](std::size_t at) {
    return at < line.size() && std::isalnum(static_cast<unsigned char>(line[at])) != 0;
  };
  for (auto at = line.find(name); at != line.npos; at = line.find(name, at + 1))
    if ((at == 0 || !part_of_word(at - 1)) && !part_of_word(at + name.size())) return at;
  return line.find(name);
}

}  // namespace

/// What to offer for the columns of one kind, and why.
UnitChoice UnitQuestions::choice_for(const std::vector<ColumnPlan>& plans, std::size_t k) const {
  const std::string kind = kind_of(plans[k].name);
  double largest = 0.0;
  for (std::size_t i = 0; i < plans.size(); ++i) {
    if (plans[i].name.empty() || kind_of(plans[i].name) != kind) continue;
    if (plans[i].lacks_unit)
      largest = std::max(largest, contents_[i].largest);
    else if (plans[i].foreign.empty() && kind != plans[i].name)
      return {{plans[i].unit}, fmt::format("{}, like '{}'", plans[i].unit, plans[i].from)};
  }
  return unit_choice(plans[k].name, largest);
}

Problem UnitQuestions::without_unit(const std::vector<ColumnPlan>& plans,
                                    const std::vector<std::size_t>& unitless) const {
  std::vector<std::pair<std::string, std::vector<std::string>>> kinds;  // reason -> columns
  std::vector<std::string> names, wishes;
  bool choose = false;
  for (const std::size_t k : unitless) {
    const UnitChoice choice = choice_for(plans, k);
    choose = choose || choice.units.size() > 1;
    names.push_back(plans[k].from);
    wishes.push_back(fmt::format("{}={}_{}", plans[k].from, map_name(plans[k]), choice.text()));
    if (kinds.empty() || kinds.back().first != choice.reason) kinds.push_back({choice.reason, {}});
    kinds.back().second.push_back(plans[k].from);
  }
  std::vector<std::string> reasons;
  for (const auto& [reason, columns] : kinds)
    reasons.push_back(fmt::format("{} ({})", in_short(columns), reason));
  const ColumnPlan& first = plans[unitless.front()];
  Problem out = of_unit(
      first,
      unitless.size() == 1
          ? fmt::format("column '{}' has no unit", first.from)
          : fmt::format("{} columns have no unit: {}", unitless.size(), in_short(names)),
      unitless.size() == 1
          ? fmt::format("taken as '{}'; {}", first.name, choice_for(plans, unitless.front()).reason)
          : fmt::format("{}", fmt::join(reasons, "; ")),
      map_option(wishes));
  if (choose) out.help += "  (keep one of the units that | divides)";
  return out;
}

Problem UnitQuestions::of_another_unit(const ColumnPlan& plan) const {
  const ForeignUnit& unit = *foreign_unit(plan.foreign);
  return of_unit(
      plan,
      fmt::format("column '{}' is in {}, which is none of plumb's units", plan.from, plan.foreign),
      std::string(unit.equals),
      fmt::format("convert the numbers and name the column {}_{}, or leave it out: {}", plan.name,
                  unit.use, map_option({plan.from + "=-"})));
}

Problem UnitQuestions::of_unit(const ColumnPlan& plan, std::string message, std::string label,
                               std::string help) const {
  const int line = std::max(dialect_.header_line, 1);
  const std::string source(text_.lines[line - 1]);
  const auto column = std::min(place_of(source, plan.from), source.size());
  return {.severity = preview_ ? Severity::kWarning : Severity::kError,
          .code = preview_ ? "W-IMPORT-UNIT" : "E-IMPORT-UNIT",
          .message = std::move(message),
          .place = Place{.file = text_.file,
                         .line = line,
                         .column = static_cast<int>(column) + 1,
                         .length = static_cast<int>(plan.from.size()),
                         .source = source,
                         .label = std::move(label)},
          .help = std::move(help)};
}

}  // namespace plumb::offline
