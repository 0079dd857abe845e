// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "cell/cell_sections.hpp"
#include "plumb/format/coupling.hpp"
#include "plumb/format/limits.hpp"

namespace plumb::offline {
namespace {

/// coupling = [{ joint = "J3", of = "J2", share = 1 }]: the controller shows as the value of J3 its
/// own angle and 1 times the value of J2.
class CouplingReader {
 public:
  CouplingReader(TomlTable& robot, CellDraft& draft) : t_(robot), draft_(draft) {}

  void read() {
    if (has_sections())
      return t_.out_of_range("coupling", "one list, which check --fix can edit: " + kExample);
    for (auto& entry : t_.tables("coupling")) {
      one(entry);
      entry.done();
    }
    auto ordered = couplings();
    if (!format::put_in_order(ordered))
      t_.out_of_range("coupling", "without a circle: these joints depend on each other");
  }

 private:
  std::vector<format::JointCoupling>& couplings() { return draft_.cell.nominal.coupling; }
  const format::JointRow& row(int joint) const {
    return draft_.cell.nominal.joints[static_cast<std::size_t>(joint)];
  }

  /// [[robot.coupling]]
  bool has_sections() {
    const toml::node* list = t_.node("coupling");
    const toml::array* entries = list == nullptr ? nullptr : list->as_array();
    const toml::table* first =
        entries == nullptr || entries->empty() ? nullptr : entries->front().as_table();
    return first != nullptr && !first->is_inline();
  }

  void one(TomlTable& entry) {
    const int joint = known(entry, "joint");
    const int of = known(entry, "of");
    const auto share = entry.number("share");
    for (const char* key : {"joint", "of", "share"})
      if (entry.node(key) == nullptr) return entry.missing(key, kExample);
    if (joint < 0 || of < 0 || !share) return;
    if (row(joint).type != row(of).type)
      return entry.out_of_range("of", "a joint that turns like the first, or slides like it");
    if (*share == 0.0 || !(std::abs(*share) <= format::kMaxCouplingRatio))
      return entry.out_of_range(
          "share", fmt::format("from {0:g} to {1:g}, and not 0", -format::kMaxCouplingRatio,
                               format::kMaxCouplingRatio));
    for (const auto& other : couplings())
      if (other.joint == joint && other.by == of)
        return entry.out_of_range("of", "another joint: these two are coupled already");
    couplings().push_back(
        {static_cast<std::uint8_t>(joint), static_cast<std::uint8_t>(of), -*share});
  }

  int known(TomlTable& entry, const std::string& key) {
    const auto name = entry.text(key);
    const int joint = name ? draft_.joint_index(*name) : -1;
    if (name && joint < 0) unknown_joint(entry, *name, *entry.node(key), draft_);
    return joint;
  }

  inline static const std::string kExample =
      "coupling = [{ joint = \"J3\", of = \"J2\", share = 1 }], where the value of J3 is its own "
      "angle and 1 times the value of J2";

  TomlTable& t_;
  CellDraft& draft_;
};

}  // namespace

void read_coupling(TomlTable& robot, CellDraft& draft) { CouplingReader(robot, draft).read(); }

}  // namespace plumb::offline
