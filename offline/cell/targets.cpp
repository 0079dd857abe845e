// SPDX-License-Identifier: Apache-2.0
#include "cell/targets.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cell/arm_columns.hpp"
#include "cell/column_names.hpp"
#include "cell/context_columns.hpp"
#include "cell/contexts.hpp"
#include "cell/last_moves.hpp"
#include "cell/measurement_warnings.hpp"
#include "cell/table_file.hpp"
#include "cell/table_place.hpp"

namespace plumb::offline {
namespace {

class TargetReader {
 public:
  TargetReader(Table table, const JointColumns& joints) : joints_(joints) {
    out_.table = std::move(table);
  }

  Targets read() {
    read_positions();
    read_orientations();
    out_.commanded = has_joints("qc");
    if (has_joints("qc") || has_joints("q")) read_seed(out_.commanded ? "qc" : "q");
    check_context_columns(out_.table, joints_.is_angle, problems_);
    problems_.stop_on_errors();
    warn_of_misspelt(out_.table);
    warn_of_values(out_.table);
    const auto joints = static_cast<Eigen::Index>(joints_.is_angle.size());
    const RowsN unseen = RowsN::Zero(out_.table.rows(), joints);
    out_.context = read_contexts({&out_.table, 1}, unseen);
    forget_order({&out_.table, 1}, unseen, out_.context);
    return std::move(out_);
  }

 private:
  void read_positions() {
    out_.p_B.resize(out_.table.rows(), 3);
    for (int k = 0; k < 3; ++k) {
      const Column* column = out_.table.find(std::string(1, "xyz"[k]));
      if (column != nullptr)
        fill(out_.p_B, k, *column);
      else
        problems_.error("E-CSV-POSITION", fmt::format("column '{}_mm' is missing", "xyz"[k]),
                        place_of_missing(out_.table, "missing here"),
                        "a target is x_mm,y_mm,z_mm,qw,qx,qy,qz in the base frame");
    }
  }

  void read_orientations() {
    ArmColumns columns;
    find_orientation(out_.table, columns, problems_);
    if (!columns.has_orientation() || !problems_.errors().empty()) return;
    out_.quat_B.resize(out_.table.rows(), 4);
    for (int i = 0; i < out_.table.rows(); ++i) {
      const auto q = orientation(out_.table, columns, i, problems_);
      out_.quat_B.row(i) << q[0], q[1], q[2], q[3];
    }
  }

  bool has_joints(const char* prefix) const {
    const auto& columns = out_.table.columns;
    return std::any_of(columns.begin(), columns.end(),
                       [&](const Column& c) { return joint_number(c.name, prefix) > 0; });
  }

  void read_seed(const char* prefix) {
    const auto joints = find_joints(out_.table, prefix, joints_.is_angle, problems_);
    out_.seed.resize(out_.table.rows(), static_cast<Eigen::Index>(joints.size()));
    for (std::size_t k = 0; k < joints.size(); ++k)
      if (joints[k] != nullptr) fill(out_.seed, static_cast<int>(k), *joints[k]);
    if (problems_.errors().empty()) to_angles(joints_.coupling, out_.seed);
  }

  static void fill(auto& matrix, int k, const Column& column) {
    for (std::size_t i = 0; i < column.values.size(); ++i) matrix(i, k) = column.values[i];
  }

  const JointColumns& joints_;
  ProblemList problems_;
  Targets out_;
};

}  // namespace

Targets targets_of(Table table, const JointColumns& joints) {
  return TargetReader(std::move(table), joints).read();
}

Targets read_targets(const std::filesystem::path& file, const JointColumns& joints) {
  return targets_of(read_table(file), joints);
}

}  // namespace plumb::offline
