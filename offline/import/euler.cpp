// SPDX-License-Identifier: Apache-2.0
#include "import/euler.hpp"

#include <fmt/format.h>

#include <array>

#include "program/problem.hpp"

namespace plumb::offline {

EulerConvention euler_convention(std::string_view name) {
  if (const auto found = find_euler_convention(name)) return *found;
  throw Failure(Exit::kUsage,
                {.code = "E-IMPORT-ROT",
                 .message = "--rot: '" + std::string(name) + "' is no order of turns",
                 .help = "xyz-fixed (R = Rz Ry Rx), xyz-moving (R = Rx Ry Rz), zyz-moving, ..., or "
                         "rotation-vector"});
}

void turn_to_quaternions(const std::string& order, Imported& data) {
  std::array<const ImportedColumn*, 3> turns{data.find("rx"), data.find("ry"), data.find("rz")};
  if (turns[0] == nullptr || turns[1] == nullptr || turns[2] == nullptr) return;
  if (turns[0]->unit == "?") return;
  std::vector<ImportedColumn> quat;
  if (order.empty()) {
    data.remarks.push_back(
        {.severity = Severity::kNote,
         .code = "N-IMPORT-ROT",
         .message = "rx, ry, rz were left out: the order of the turns is not known",
         .help = "--rot xyz-fixed if R = Rz Ry Rx, --rot xyz-moving if R = Rx Ry Rz"});
  } else {
    const EulerConvention convention = euler_convention(order);
    for (const char* name : {"qw", "qx", "qy", "qz"}) quat.push_back({"", name, "", {}});
    const auto x = si_values(*turns[0]), y = si_values(*turns[1]), z = si_values(*turns[2]);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const auto q = quaternion(convention, {x[i], y[i], z[i]});
      for (std::size_t k = 0; k < 4; ++k) quat[k].text.add(fmt::format("{:.12g}", q[k]));
    }
  }
  std::erase_if(data.columns, [](const ImportedColumn& c) {
    return c.name == "rx" || c.name == "ry" || c.name == "rz";
  });
  for (auto& column : quat) data.columns.push_back(std::move(column));
}

}  // namespace plumb::offline
