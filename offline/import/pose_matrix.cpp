// SPDX-License-Identifier: Apache-2.0
#include "import/pose_matrix.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <map>

#include "import/heading.hpp"
#include "import/number_text.hpp"
#include "import/words.hpp"

namespace plumb::offline {
namespace {

/// Error of R R^T that a rotation matrix has whose numbers are written with few digits.
constexpr double kRounded = 2e-3;

using Matrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using Places = std::map<int, std::size_t>;  // 10 * row + column, as written -> column of the file

/// The columns by the word before two digits.
std::map<std::string, Places> families(const std::vector<ColumnPlan>& plans) {
  std::map<std::string, Places> out;
  for (std::size_t k = 0; k < plans.size(); ++k) {
    if (plans[k].wished) continue;
    const std::string text = folded(read_heading(plans[k].from).name);
    const auto end = text.find_last_not_of("0123456789") + 1;
    if (text.size() - end == 2) out[text.substr(0, end)][std::stoi(text.substr(end))] = k;
  }
  return out;
}

std::optional<PoseMatrix> places_in(const Places& family, int first) {
  PoseMatrix out;
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k) {
      const auto found = family.find(10 * (i + first) + k + first);
      if (found == family.end() && i < 3) return std::nullopt;
      if (found == family.end()) continue;
      if (i < 3)
        out.at[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] = found->second;
      else
        out.last_row.push_back(found->second);
    }
  return out;
}

bool is_rotation(const Matrix3& R) {
  return (R * R.transpose() - Matrix3::Identity()).cwiseAbs().maxCoeff() < kRounded &&
         R.determinant() > 0.0;
}

bool holds_rotations(const PoseMatrix& matrix, const std::vector<ColumnContent>& contents) {
  const std::size_t rows = contents[matrix.at[0][0]].numbers.size();
  for (const auto& row : matrix.at)
    for (const std::size_t column : row)
      if (rows == 0 || contents[column].numbers.size() != rows) return false;
  for (std::size_t n = 0; n < rows; ++n) {
    Matrix3 R;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        R(static_cast<int>(i), static_cast<int>(k)) = contents[matrix.at[i][k]].numbers[n];
    if (!is_rotation(R)) return false;
  }
  return true;
}

/// Unit quaternion (w, x, y, z), w >= 0, of a rotation matrix, row by row.
std::array<double, 4> quaternion_of(const std::array<double, 9>& rotation) {
  const Eigen::Map<const Matrix3> R(rotation.data());
  Eigen::Quaterniond q{Eigen::Matrix3d(R)};
  q.normalize();
  const double sign = q.w() < 0 ? -1.0 : 1.0;
  return {sign * q.w(), sign * q.x(), sign * q.y(), sign * q.z()};
}

/// Columns T00 to T33, or T11 to T44, "m_0_3", "R[1][4]", whose numbers are a rotation and a
/// position in every row; nothing if there are none, or several.
std::optional<PoseMatrix> matrix_in(const std::vector<ColumnPlan>& plans,
                                    const std::vector<ColumnContent>& contents) {
  std::optional<PoseMatrix> out;
  for (const auto& [word, family] : families(plans)) {
    auto matrix = places_in(family, family.contains(0) ? 0 : 1);
    if (!matrix || !holds_rotations(*matrix, contents)) continue;
    if (out) return std::nullopt;
    out = std::move(matrix);
  }
  return out;
}

}  // namespace

std::optional<PoseMatrix> take_matrix(std::vector<ColumnPlan>& plans,
                                      const std::vector<ColumnContent>& contents,
                                      std::vector<Problem>& remarks) {
  const auto is_taken = [&](const char* name) {
    return std::any_of(plans.begin(), plans.end(),
                       [&](const ColumnPlan& plan) { return plan.name == name; });
  };
  if (is_taken("x") || is_taken("y") || is_taken("z")) return std::nullopt;
  auto matrix = matrix_in(plans, contents);
  if (!matrix) return std::nullopt;
  for (int i = 0; i < 3; ++i) {
    ColumnPlan& plan = plans[matrix->at[i][3]];
    const WrittenHeading heading = read_heading(plan.from);
    plan.name = std::string(1, "xyz"[i]);
    plan.unit = heading.unit;
    plan.foreign = heading.foreign;
    plan.lacks_unit = plan.unit.empty() && plan.foreign.empty();
  }
  remarks.push_back(
      {.severity = Severity::kNote,
       .code = "N-IMPORT-MATRIX",
       .message = fmt::format("{} to {} are a position and an orientation, as a matrix: taken as "
                              "those measured",
                              plans[matrix->at[0][0]].from, plans[matrix->at[2][3]].from),
       .help = "if the controller computed them, name the position nx, ny, nz with --map"});
  matrix->turns = !is_taken("qw");
  return matrix;
}

std::vector<ImportedColumn> orientation_of(const PoseMatrix& matrix, const CellTable& cells,
                                           char decimal) {
  std::vector<ImportedColumn> quat;
  for (const char* name : {"qw", "qx", "qy", "qz"}) quat.push_back({"", name, "", {}});
  for (std::size_t row = 0; row < cells.size(); ++row) {
    std::array<double, 9> r{};
    for (int i = 0; i < 9; ++i)
      r[i] = number_in(cells[row][matrix.at[i / 3][i % 3]], decimal).value_or(NAN);
    const auto q = quaternion_of(r);
    for (std::size_t k = 0; k < 4; ++k) quat[k].text.add(fmt::format("{:.9g}", q[k]));
  }
  return quat;
}

}  // namespace plumb::offline
