// SPDX-License-Identifier: Apache-2.0
#include "import/content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cell/column_names.hpp"
#include "cell/units.hpp"
#include "import/number_text.hpp"

namespace plumb::offline {
namespace {

constexpr std::size_t kLookedRows = 500;

/// A unit, and the range in which the largest number of a column makes it plausible.
struct Candidate {
  const char* unit;
  double least, most;  // bounds of that number, in the unit
};

using Candidates = std::vector<Candidate>;

/// Trackers reach from 0.05 m to 30 m; joint angles reach more than 3 degrees and, if
/// they are in radians, less than two turns; a standard deviation lies between 0.1 um and 5 mm.
const Candidates& candidates_of(const std::string& name) {
  static const Candidates kPoint{
      {"mm", 50, 3e4}, {"m", 0.05, 30}, {"in", 2, 390}, {"um", 5e5, 3e7}};
  static const Candidates kSigma{{"um", 0.1, 5e3}, {"mm", 1e-4, 5}, {"m", 1e-7, 5e-3}};
  static const Candidates kAngle{{"deg", 3, 3600}, {"rad", 0.05, 12.6}, {"mrad", 720, 12600}};
  static const Candidates kLoad{{"kg", 0, 3000}, {"g", 50, 3e6}};
  static const Candidates kWarmth{{"degC", 0, 150}, {"K", 230, 450}};
  static const Candidates kTime{{"s", 0, 1e9}, {"ms", 0, 1e12}, {"us", 0, 1e15}};
  static const Candidates kNone;
  const auto allowed = allowed_quantities(name);
  if (allowed.empty()) return kNone;
  switch (allowed.front()) {
    case Quantity::kLength:
      return name.size() == 2 && name[0] == 's' ? kSigma : kPoint;
    case Quantity::kAngle:
      return kAngle;
    case Quantity::kMass:
      return kLoad;
    case Quantity::kTemperature:
      return kWarmth;
    case Quantity::kTime:
      return kTime;
    default:
      return kNone;
  }
}

std::string meaning(const std::string& unit, double largest) {
  const double si = unit_of(unit)->to_si(largest);
  switch (unit_of(unit)->quantity) {
    case Quantity::kLength:
      return si < 0.01 ? fmt::format("{:.3g} um", si * 1e6) : fmt::format("{:.3g} m", si);
    case Quantity::kAngle:
      return fmt::format("{:.3g} deg", si * 180.0 / M_PI);
    case Quantity::kMass:
      return fmt::format("{:.3g} kg", si);
    case Quantity::kTemperature:
      return fmt::format("{:.1f} degC", si);
    default:
      return fmt::format("{:.3g} {}", largest, unit);
  }
}

}  // namespace

std::vector<ColumnContent> column_contents(const RawRows& rows) {
  const std::size_t columns = rows.dialect.header.size(), count = rows.cells.size();
  std::vector<ColumnContent> out(columns);
  const std::size_t step = std::max<std::size_t>(1, count / kLookedRows);
  for (std::size_t k = 0; k < columns; ++k) {
    const auto cell = [&](std::size_t i) { return rows.cells[i][k]; };
    for (std::size_t i = 0; i < count && out[k].empty; ++i) out[k].empty = cell(i).empty();
    bool numbers = true;
    for (std::size_t i = 0; i < count && numbers; i += step) {
      const auto number = number_in(cell(i), rows.dialect.decimal);
      numbers = number.has_value();
      if (numbers) out[k].numbers.push_back(*number);
    }
    if (!numbers) out[k].numbers.clear();
    for (const double v : out[k].numbers) out[k].largest = std::max(out[k].largest, std::abs(v));
  }
  return out;
}

std::string UnitChoice::text() const { return fmt::format("{}", fmt::join(units, "|")); }

UnitChoice unit_choice(const std::string& name, double largest) {
  UnitChoice out;
  const auto& candidates = candidates_of(name);
  std::vector<std::string> meanings;
  const auto take = [&](const Candidate& c) {
    out.units.emplace_back(c.unit);
    meanings.push_back(fmt::format("in {} {}", c.unit, meaning(c.unit, largest)));
  };
  for (const auto& c : candidates)
    if (largest >= c.least && largest <= c.most) take(c);
  if (out.units.empty())
    for (const auto& c : candidates) take(c);
  if (out.units.empty()) out.units.push_back(usual_unit(name));
  if (meanings.empty() || allowed_quantities(name).front() == Quantity::kTime)
    out.reason = fmt::format("up to {:.6g}", largest);
  else
    out.reason = fmt::format("up to {:.6g}: {}", largest, fmt::join(meanings, ", "));
  return out;
}

}  // namespace plumb::offline
