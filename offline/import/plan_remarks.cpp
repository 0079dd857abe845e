// SPDX-License-Identifier: Apache-2.0
#include "import/plan_remarks.hpp"

#include <fmt/format.h>

#include "cell/column_names.hpp"
#include "cell/units.hpp"
#include "import/heading.hpp"
#include "import/map_option.hpp"

namespace plumb::offline {
namespace {

/// The unit of the column, or the usual one of uncertainties.
std::string unit_in_wish(const ColumnPlan& plan) {
  return plan.unit.empty() || plan.unit == "?" ? "um" : plan.unit;
}

}  // namespace

void say_of_uncertainties(const std::vector<ColumnPlan>& plans, std::vector<Problem>& remarks) {
  std::vector<std::string> divided, as_they_are, unclear, wishes;
  bool unit_known = false;
  std::string said;
  double divisor = 1.0;
  for (const auto& plan : plans) {
    if (plan.divisor != 1.0) {
      divided.push_back(plan.from), said = plan.said, divisor = plan.divisor;
      as_they_are.push_back(fmt::format("{}={}_{}", plan.from, plan.name, unit_in_wish(plan)));
    }
    if (!plan.named.uncertain || plan.wished) continue;
    unclear.push_back(plan.from);
    if (wishes.empty()) unit_known = !plan.uncertain_unit.empty();
    wishes.push_back(plan.uncertain_unit.empty() ? "um" : plan.uncertain_unit);
  }
  if (!divided.empty())
    remarks.push_back(
        {.severity = Severity::kNote,
         .code = "N-IMPORT-EXPANDED",
         .message = fmt::format("{} hold expanded uncertainties ({}): divided by {:g} they are "
                                "one standard deviation",
                                in_short(divided), said, divisor),
         .help = "if they already are one: " + map_option(as_they_are)});
  if (!unclear.empty())
    remarks.push_back(
        {.severity = Severity::kWarning,
         .code = "W-IMPORT-UNCERTAINTY",
         .message = fmt::format("{} left out: nothing says of which axis, or of how many standard "
                                "deviations, these uncertainties are",
                                in_short(unclear)),
         .help =
             fmt::format("{} if one, or u95x_{} if two (k = 2, 95 %){}",
                         map_option({unclear.front() + "=sx_" + wishes.front()}), wishes.front(),
                         unit_known ? "" : "; mm in place of um if that is the unit")});
}

void say_of_sliding(const std::vector<ColumnPlan>& plans, std::vector<Problem>& remarks) {
  for (const auto& plan : plans) {
    const auto unit = unit_of(plan.unit);
    if (!plan.wished || joint_number(plan.name, "q") == 0 || !unit ||
        unit->quantity != Quantity::kLength)
      continue;
    remarks.push_back(
        {.severity = Severity::kNote,
         .code = "N-IMPORT-SLIDE",
         .message = fmt::format("{} is taken in {}: that is right for a sliding joint only",
                                plan.name, plan.unit),
         .help = "if it turns: " + map_option({fmt::format("{}={}_deg", plan.from, plan.name)})});
  }
}

}  // namespace plumb::offline
