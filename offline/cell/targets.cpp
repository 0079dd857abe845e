// SPDX-License-Identifier: Apache-2.0
#include "cell/targets.hpp"

#include <fmt/format.h>

#include <cmath>

namespace plumb::offline {
namespace {

constexpr double kQuaternionSlack = 1e-3;

[[noreturn]] void fail(const Table& table, std::string code, std::string message, std::string help,
                       int row = -1) {
  Place place{.file = table.file};
  if (row >= 0) place.line = table.lines[row];
  throw Failure(Exit::kInput, {.code = std::move(code),
                               .message = std::move(message),
                               .place = place,
                               .help = std::move(help)});
}

const Column* of_kind(const Table& table, const std::string& name, Quantity quantity) {
  const Column* column = table.find(name);
  if (column != nullptr && column->quantity != quantity)
    fail(table, "E-CSV-KIND", fmt::format("column '{}' has the wrong kind of unit", column->header),
         "lengths in mm, turning joints in deg, sliding joints in mm");
  return column;
}

/// Seed columns PREFIX1 … PREFIXn; all of them or none.
bool read_seed(Targets& out, const std::string& prefix, const std::vector<bool>& is_angle) {
  const auto n = static_cast<Eigen::Index>(is_angle.size());
  RowsN seed(out.table.rows(), n);
  int found = 0;
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto kind = is_angle[k] ? Quantity::kAngle : Quantity::kLength;
    const Column* column = of_kind(out.table, fmt::format("{}{}", prefix, k + 1), kind);
    if (column == nullptr) continue;
    ++found;
    for (int i = 0; i < out.table.rows(); ++i) seed(i, k) = column->values[i];
  }
  if (found == 0) return false;
  if (found != n)
    fail(out.table, "E-CSV-JOINT",
         fmt::format("{} of {} joint columns {}1 … are there", found, n, prefix),
         "give every joint, or none");
  out.seed = std::move(seed);
  return true;
}

}  // namespace

Targets read_targets(const std::filesystem::path& file, const std::vector<bool>& joint_is_angle) {
  Targets out;
  out.table = read_table(file);
  const int n = out.table.rows();
  out.p_B.resize(n, 3);
  const char* const axes[] = {"x", "y", "z"};
  for (int k = 0; k < 3; ++k) {
    const Column* column = of_kind(out.table, axes[k], Quantity::kLength);
    if (column == nullptr)
      fail(out.table, "E-CSV-POSITION", fmt::format("column '{}_mm' is missing", axes[k]),
           "a target is x_mm,y_mm,z_mm,qw,qx,qy,qz in the base frame");
    for (int i = 0; i < n; ++i) out.p_B(i, k) = column->values[i];
  }
  const char* const parts[] = {"qw", "qx", "qy", "qz"};
  int found = 0;
  for (const char* part : parts) found += out.table.find(part) != nullptr ? 1 : 0;
  if (found != 0 && found != 4)
    fail(out.table, "E-CSV-QUATERNION", "the quaternion is not complete",
         "give qw, qx, qy and qz, or none of them");
  if (found == 4) {
    out.quat_B.resize(n, 4);
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < 4; ++k) out.quat_B(i, k) = out.table.find(parts[k])->values[i];
      const double norm = out.quat_B.row(i).norm();
      if (std::abs(norm - 1.0) > kQuaternionSlack)
        fail(out.table, "E-CSV-QUATERNION",
             fmt::format("the quaternion has length {:.6g}, not 1", norm),
             "check the order qw, qx, qy, qz and the decimals", i);
      out.quat_B.row(i) /= norm;
    }
  }
  out.commanded = read_seed(out, "qc", joint_is_angle);
  if (!out.commanded) read_seed(out, "q", joint_is_angle);
  return out;
}

}  // namespace plumb::offline
