// SPDX-License-Identifier: Apache-2.0
#include "import/radians.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cell/column_names.hpp"
#include "cell/units.hpp"
#include "import/heading.hpp"
#include "import/map_option.hpp"

namespace plumb::offline {
namespace {

/// One turn [rad], rounded up.
constexpr double kOneTurn = 6.3;
/// Points that move by less may do so although the joints turn by a few degrees only.
constexpr double kLeastMove_m = 0.2;
/// Lever arm by which joints that all turn the tool the same way would have to move it.
constexpr double kLongLever_m = 1.0;
/// Fewer rows are not judged.
constexpr int kRowsToJudge = 8;

/// Largest minus smallest number of a column, in SI; 0 if it is not there.
double span_of(const Imported& data, const std::string& name) {
  const ImportedColumn* column = data.find(name);
  if (column == nullptr || column->text.empty() || !unit_of(column->unit)) return 0.0;
  const auto values = si_values(*column);
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

}  // namespace

void say_of_radians(const std::vector<ColumnPlan>& plans,
                    const std::vector<ColumnContent>& contents, Imported& data) {
  std::vector<std::string> names, wishes;
  double largest = 0.0, turned = 0.0;
  for (std::size_t k = 0; k < plans.size(); ++k) {
    if (joint_number(plans[k].name, "q") == 0 || plans[k].unit != "deg" || plans[k].wished)
      continue;
    names.push_back(plans[k].from);
    wishes.push_back(fmt::format("{}={}_rad", plans[k].from, plans[k].name));
    largest = std::max(largest, contents[k].largest);
    turned += span_of(data, plans[k].name);
  }
  const double moved = std::hypot(span_of(data, "x"), span_of(data, "y"), span_of(data, "z"));
  if (names.empty() || data.rows() < kRowsToJudge || largest > kOneTurn || moved < kLeastMove_m ||
      moved < turned * kLongLever_m)
    return;
  data.remarks.push_back(
      {.severity = Severity::kWarning,
       .code = "W-IMPORT-RADIANS",
       .message = fmt::format("{} say deg, but no number is beyond {:.3g}: all joints together "
                              "turn by {:.2g} deg and the points move by {:.2g} m, which fits "
                              "radians",
                              in_short(names), largest, turned * 180.0 / M_PI, moved),
       .help = "if they are radians: " + map_option(wishes)});
}

}  // namespace plumb::offline
