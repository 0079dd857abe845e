// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "cell/cell_sections.hpp"
#include "plumb/format/coupling.hpp"
#include "plumb/format/limits.hpp"

namespace plumb::offline {
namespace {

/// coupling = { "J3,J2" = -1 }: the angle of J3 is the controller's value of it plus -1 times that
/// of J2.
class CouplingReader {
 public:
  CouplingReader(TomlTable& robot, CellDraft& draft) : t_(robot), draft_(draft) {}

  void read() {
    auto table = t_.table("coupling");
    if (!table) return;
    if (!t_.node("coupling")->as_table()->is_inline())
      return t_.out_of_range("coupling", "in one line: coupling = { \"J3,J2\" = -1 }");
    for (const auto& pair : table->keys()) one(*table, pair);
    auto ordered = couplings();
    if (!format::put_in_order(ordered))
      t_.out_of_range("coupling", "without a circle: these joints depend on each other");
    table->done();
  }

 private:
  std::vector<format::JointCoupling>& couplings() { return draft_.cell.nominal.coupling; }
  const format::JointRow& row(int joint) const {
    return draft_.cell.nominal.joints[static_cast<std::size_t>(joint)];
  }

  void one(TomlTable& table, const std::string& pair) {
    const auto ratio = table.number(pair);
    const auto comma = pair.find(',');
    if (!ratio) return;
    if (comma == std::string::npos)
      return table.out_of_range(pair, "of two joints: \"J3,J2\" = -1");
    const int joint = known(table, pair, pair.substr(0, comma));
    const int by = known(table, pair, pair.substr(comma + 1));
    if (joint < 0 || by < 0) return;
    if (row(joint).type != row(by).type)
      return table.out_of_range(pair, "of two joints that turn, or of two that slide");
    if (*ratio == 0.0 || !(std::abs(*ratio) <= format::kMaxCouplingRatio))
      return table.out_of_range(
          pair, fmt::format("from {0:g} to {1:g}, and not 0", -format::kMaxCouplingRatio,
                            format::kMaxCouplingRatio));
    for (const auto& other : couplings())
      if (other.joint == joint && other.by == by)
        return table.out_of_range(pair, "another pair: these two are coupled already");
    couplings().push_back(
        {static_cast<std::uint8_t>(joint), static_cast<std::uint8_t>(by), *ratio});
  }

  int known(TomlTable& table, const std::string& pair, std::string name) {
    name.erase(0, name.find_first_not_of(' '));
    name.erase(name.find_last_not_of(' ') + 1);
    const int joint = draft_.joint_index(name);
    if (joint < 0) unknown_joint(table, name, *table.node(pair), draft_);
    return joint;
  }

  TomlTable& t_;
  CellDraft& draft_;
};

}  // namespace

void read_coupling(TomlTable& robot, CellDraft& draft) { CouplingReader(robot, draft).read(); }

}  // namespace plumb::offline
