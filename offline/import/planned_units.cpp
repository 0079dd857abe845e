// SPDX-License-Identifier: Apache-2.0
#include "import/planned_units.hpp"

#include <fmt/format.h>

#include "cell/column_names.hpp"
#include "cell/units.hpp"
#include "import/heading.hpp"

namespace plumb::offline {

void take_stated_units(const StatedUnits& stated, const std::string& file,
                       std::vector<ColumnPlan>& plans, std::vector<Problem>& remarks) {
  std::vector<std::string> lengths, angles;
  for (auto& plan : plans) {
    if (!plan.lacks_unit) continue;
    const auto allowed = allowed_quantities(plan.name);
    const bool angle = allowed.front() == Quantity::kAngle;
    const bool length = allowed.front() == Quantity::kLength;
    const std::string unit = angle ? stated.angle : length ? stated.length : "";
    if (unit.empty()) continue;
    plan.unit = unit;
    plan.lacks_unit = false;
    (angle ? angles : lengths).push_back(plan.from);
  }
  const auto say = [&](const std::vector<std::string>& columns, const std::string& unit, int line) {
    if (columns.empty()) return;
    remarks.push_back(
        {.severity = Severity::kNote,
         .code = "N-IMPORT-STATED",
         .message = fmt::format("{}: in {}, as line {} says", in_short(columns), unit, line),
         .place = Place{.file = file, .line = line},
         .help = "--map says otherwise"});
  };
  say(angles, stated.angle, stated.angle_line);
  say(lengths, stated.length, stated.length_line);
}

}  // namespace plumb::offline
