// SPDX-License-Identifier: Apache-2.0
#include "import/column_guess.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <regex>

#include "cell/column_names.hpp"
#include "cell/units.hpp"
#include "program/problem.hpp"

namespace plumb::offline {
namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// "°", "[mm]", "Millimeter" as plumb writes them.
std::string known_unit(std::string text) {
  std::erase_if(text,
                [](char c) { return c == '[' || c == ']' || c == '(' || c == ')' || c == ' '; });
  static const std::map<std::string, std::string> kOther{
      {"°", "deg"},         {"degree", "deg"}, {"degrees", "deg"}, {"grad", "deg"},
      {"°c", "degC"},       {"degc", "degC"},  {"c", "degC"},      {"celsius", "degC"},
      {"millimeter", "mm"}, {"meter", "m"},    {"µm", "um"},       {"μm", "um"},
      {"inch", "in"},       {"radian", "rad"}, {"radians", "rad"}, {"sec", "s"},
      {"kg", "kg"},         {"k", "K"},        {"n", "N"},         {"nm", "Nm"}};
  if (unit_of(text)) return text;
  const std::string small = lower(text);
  if (unit_of(small)) return small;
  const auto found = kOther.find(small);
  return found == kOther.end() ? std::string() : found->second;
}

/// The unit of others that a text is, or empty.
std::string unit_of_others(std::string text) {
  std::erase_if(text,
                [](char c) { return c == '[' || c == ']' || c == '(' || c == ')' || c == ' '; });
  for (const auto& tried : {text, lower(text)})
    if (foreign_unit(tried) != nullptr) return tried;
  return {};
}

/// Header without its unit, and the unit.
struct Named {
  std::string name, unit;
};

Named split_unit(const std::string& header, std::string (*read_unit)(std::string)) {
  static const std::regex kBrackets(R"(^(.*?)\s*[\[\(]\s*([^\]\)]*)\s*[\]\)]\s*$)");
  static const std::regex kTail(R"(^(.*?)\s*[/_\s,]\s*([^\s/_,]+)\s*$)");
  std::smatch match;
  for (const auto* pattern : {&kBrackets, &kTail})
    if (std::regex_match(header, match, *pattern))
      if (const std::string unit = read_unit(match[2]); !unit.empty()) return {match[1], unit};
  return {header, ""};
}

/// The canonical name of what a column is called, or empty.
std::string canonical(const std::string& raw) {
  std::string name;
  for (char c : lower(raw))
    if (std::isalnum(static_cast<unsigned char>(c))) name += c;
  static const std::regex kJoint(R"(^(?:q|j|a|joint|axis|achse|theta|actualq)0?([1-9])$)");
  static const std::regex kCommanded(R"(^(?:qc|qcmd|cmdq|targetq)([1-9])$)");
  static const std::regex kAxis(
      R"(^(?:measured|meas|measurement|m|pos|position|tracker)?([xyz])$)");
  static const std::regex kNominal(R"(^(?:n|nom|nominal)([xyz])$)");
  static const std::regex kSigma(R"(^(?:s|sigma|std|stdev|measurementstd)([xyz])$)");
  static const std::regex kTurn(R"(^(?:measured|measurement|m)?r([xyz])$)");
  std::smatch match;
  if (std::regex_match(name, match, kJoint)) return "q" + match[1].str();
  if (std::regex_match(name, match, kCommanded)) return "qc" + match[1].str();
  if (std::regex_match(name, match, kAxis)) return match[1];
  if (std::regex_match(name, match, kNominal)) return "n" + match[1].str();
  if (std::regex_match(name, match, kSigma)) return "s" + match[1].str();
  if (std::regex_match(name, match, kTurn)) return "r" + match[1].str();
  static const std::map<std::string, std::string> kWords{{"pose", "pose"},
                                                         {"point", "pose"},
                                                         {"pointname", "pose"},
                                                         {"name", "pose"},
                                                         {"poseid", "pose"},
                                                         {"id", "pose"},
                                                         {"qw", "qw"},
                                                         {"qx", "qx"},
                                                         {"qy", "qy"},
                                                         {"qz", "qz"},
                                                         {"payload", "payload"},
                                                         {"load", "payload"},
                                                         {"temp", "temp"},
                                                         {"temperature", "temp"},
                                                         {"t", "t"},
                                                         {"timestamp", "time"},
                                                         {"time", "time"},
                                                         {"datetime", "time"},
                                                         {"set", "set"},
                                                         {"note", "note"},
                                                         {"comment", "note"},
                                                         {"repeat", "repeat"}};
  const auto found = kWords.find(name);
  return found == kWords.end() ? std::string() : found->second;
}

bool needs_unit(const std::string& name) {
  return !name.empty() && !allowed_quantities(name).empty();
}

[[noreturn]] void refuse(const char* code, std::string message, std::string help) {
  throw Failure(Exit::kUsage,
                {.code = code, .message = std::move(message), .help = std::move(help)});
}

void apply_wish(const std::string& wish, std::vector<ColumnPlan>& plans) {
  const auto equals = wish.rfind('=');
  if (equals == wish.npos || equals == 0 || equals + 1 == wish.size())
    refuse("E-IMPORT-MAP", fmt::format("--map '{}' is not OLD=NEW_UNIT", wish),
           "--map \"Goal x=nx_m\", or --map note=- to leave a column out");
  const std::string from = wish.substr(0, equals), to = wish.substr(equals + 1);
  std::vector<std::string> names;
  for (const auto& plan : plans) names.push_back(plan.from);
  const auto at = std::find(names.begin(), names.end(), from);
  if (at == names.end()) {
    const auto guess = did_you_mean(from, names);
    refuse("E-IMPORT-MAP", fmt::format("--map: the file has no column '{}'", from),
           guess ? fmt::format("did you mean '{}'?", *guess)
                 : fmt::format("its columns: {}", fmt::join(names, ", ")));
  }
  ColumnPlan& plan = plans[static_cast<std::size_t>(at - names.begin())];
  if (plan.wished)
    refuse("E-IMPORT-MAP", fmt::format("--map: column '{}' is named twice", from),
           "say once what it is");
  plan.wished = true;
  plan.lacks_unit = false;
  plan.foreign.clear();
  if (to == "-") {
    plan.name.clear();
    return;
  }
  if (unitless_quantity(to)) {
    plan.name = to;
    plan.unit.clear();
    return;
  }
  const Heading heading = split_heading(to);
  if (heading.unit.empty() || !unit_of(heading.unit))
    refuse("E-IMPORT-MAP", fmt::format("--map: '{}' has no unit plumb knows", to),
           foreign_unit(heading.unit) != nullptr
               ? fmt::format("convert the numbers first: {}", foreign_unit(heading.unit)->equals)
               : fmt::format("--map \"{}={}_{}\"", from, heading.name, usual_unit(heading.name)));
  plan.name = heading.name;
  plan.unit = heading.unit;
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

}  // namespace

ColumnPlan guess_column(const std::string& header, const std::string& unit_row) {
  ColumnPlan out{.from = header};
  // A heading in plumb's own style is taken at its word.
  const Heading own = split_heading(header);
  if (unitless_quantity(header)) {
    out.name = header;
    return out;
  }
  if (!own.unit.empty() && unit_of(own.unit)) {
    out.name = own.name;
    out.unit = own.unit;
    if (const std::string name = canonical(own.name);
        allowed_quantities(own.name).empty() && !name.empty())
      out.name = name;
    return out;
  }
  const Named named = split_unit(header, known_unit);
  out.name = canonical(named.name);
  out.unit = !named.unit.empty() ? named.unit : known_unit(unit_row);
  if (unitless_quantity(out.name)) out.unit.clear();
  out.lacks_unit = needs_unit(out.name) && out.unit.empty();
  const Named other = split_unit(header, unit_of_others);
  const std::string name = canonical(other.name);
  if (!named.unit.empty() || !needs_unit(name)) return out;
  out.foreign = !other.unit.empty() ? other.unit : out.unit.empty() ? unit_of_others(unit_row) : "";
  if (!out.foreign.empty()) out.name = name;
  return out;
}

std::vector<ColumnPlan> plan_columns(const std::vector<std::string>& header,
                                     const std::vector<std::string>& units,
                                     const std::vector<std::string>& wishes) {
  std::vector<ColumnPlan> out;
  for (std::size_t i = 0; i < header.size(); ++i)
    out.push_back(guess_column(header[i], i < units.size() ? units[i] : ""));
  for (const auto& wish : wishes) apply_wish(wish, out);
  // A wish outdoes a guess of the same name.
  for (const auto& wished : out)
    for (auto& other : out)
      if (wished.wished && !other.wished && !wished.name.empty() && other.name == wished.name)
        other.name.clear();
  refuse_doubles(out);
  return out;
}

}  // namespace plumb::offline
