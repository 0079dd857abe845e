// SPDX-License-Identifier: Apache-2.0
#include "import/joint_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "cell/column_names.hpp"
#include "import/heading.hpp"
#include "import/unit_words.hpp"
#include "import/words.hpp"

namespace plumb::offline {
namespace {

constexpr std::size_t kFewestNumbered = 4;

using Order = std::vector<std::size_t>;  // columns, from base to tip

/// The columns that are called so, if each name is that of one column.
Order columns_called(const std::vector<std::string>& names, const std::vector<ColumnPlan>& plans) {
  Order out;
  for (const auto& name : names) {
    const std::string wanted = folded(name);
    std::size_t found = plans.size();
    for (std::size_t k = 0; k < plans.size(); ++k)
      if (!wanted.empty() && folded(read_heading(plans[k].from).name) == wanted) found = k;
    if (found == plans.size()) return {};
    out.push_back(found);
  }
  return out;
}

/// "panda_joint1" to "panda_joint7", if there is one such word.
Order numbered(const std::vector<ColumnPlan>& plans) {
  std::map<std::string, std::map<std::string, std::size_t>> words;
  for (std::size_t k = 0; k < plans.size(); ++k) {
    const bool known = !plans[k].name.empty() && !allowed_quantities(plans[k].name).empty();
    if (known || plans[k].wished) continue;
    const std::string text = folded(read_heading(plans[k].from).name);
    const auto end = text.find_last_not_of("0123456789") + 1;
    const std::string word = text.substr(0, end);
    if (end < text.size() && (word.ends_with("joint") || word.ends_with("jointa")))
      words[word][text.substr(end)] = k;
  }
  if (words.size() != 1) return {};
  Order out;
  const auto& columns = words.begin()->second;
  for (std::size_t j = 1; j <= columns.size(); ++j) {
    const auto at = columns.find(std::to_string(j));
    if (at == columns.end()) return {};
    out.push_back(at->second);
  }
  return out.size() >= kFewestNumbered ? out : Order{};
}

void take_as_joint(ColumnPlan& plan, std::size_t joint, const std::string& unit_row) {
  const WrittenHeading heading = read_heading(plan.from);
  plan.name = fmt::format("q{}", joint);
  plan.unit = heading.unit.empty() ? known_unit(unit_row) : heading.unit;
  plan.foreign = plan.unit.empty() ? heading.foreign : "";
  plan.lacks_unit = plan.unit.empty() && plan.foreign.empty();
  plan.named = {};
}

}  // namespace

void name_joints(const std::vector<std::string>& joints, const std::vector<std::string>& units,
                 std::vector<ColumnPlan>& plans, std::vector<Problem>& remarks) {
  static const std::vector<std::string> kUniversalRobots{
      "shoulder_pan_joint", "shoulder_lift_joint", "elbow_joint",
      "wrist_1_joint",      "wrist_2_joint",       "wrist_3_joint"};
  Order order = joints.empty() ? Order{} : columns_called(joints, plans);
  if (order.empty()) order = columns_called(kUniversalRobots, plans);
  if (order.empty()) order = numbered(plans);
  std::vector<std::string> named;
  for (std::size_t j = 0; j < order.size(); ++j) {
    ColumnPlan& plan = plans[order[j]];
    if (plan.wished || plan.name == fmt::format("q{}", j + 1)) continue;
    take_as_joint(plan, j + 1, order[j] < units.size() ? units[order[j]] : "");
    named.push_back(fmt::format("{} is q{}", plan.from, j + 1));
  }
  if (named.empty()) return;
  remarks.push_back(
      {.severity = Severity::kNote,
       .code = "N-IMPORT-JOINTS",
       .message = fmt::format("columns are called as joints are: {}", fmt::join(named, ", ")),
       .help = "--map says otherwise"});
}

}  // namespace plumb::offline
