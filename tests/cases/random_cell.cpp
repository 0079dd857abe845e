// SPDX-License-Identifier: Apache-2.0
#include "tests/cases/random_cell.hpp"

#include <cmath>
#include <stdexcept>

#include "simulate/arm_rows.hpp"
#include "simulate/random.hpp"

namespace plumb::offline {
namespace {

using format::Convention;
using format::JointType;
using sim::Random;
using sim::SheetRow;

constexpr int kMinJoints = 4;
constexpr int kMaxJoints = 7;

double rounded(Random& random, double low, double high) {
  return std::round(random.uniform(low, high));
}

double quarter_turn(Random& random) { return 90.0 * (random.below(4) - 1); }

// DH rows in the standard convention. There are never two successive pairs of parallel axes, so
// that every axis moves the tool point.
std::vector<SheetRow> revolute_rows(int joints, Random& random) {
  std::vector<SheetRow> rows(joints);
  bool parallel_before = true;  // so that the first two axes are perpendicular
  for (int i = 0; i < joints; ++i) {
    SheetRow& row = rows[i];
    row.theta_deg = quarter_turn(random);
    row.q_max = rounded(random, 90, 170);
    row.q_min = -rounded(random, 90, 170);
    row.d_mm = random.below(4) == 0 ? 0.0 : rounded(random, 100, 450);
    if (i + 1 == joints) break;
    row.parallel_next = !parallel_before && random.below(3) > 0;
    row.alpha_deg = row.parallel_next ? 0.0 : (random.below(2) == 0 ? 90.0 : -90.0);
    if (row.parallel_next) row.a_mm = rounded(random, 250, 700);
    if (!row.parallel_next && random.below(2) == 0) row.a_mm = rounded(random, 30, 200);
    parallel_before = row.parallel_next;
  }
  return rows;
}

std::vector<SheetRow> scara_rows(Random& random) {
  std::vector<SheetRow> rows(4);
  for (auto& row : rows) {
    row.q_max = rounded(random, 110, 170);
    row.q_min = -row.q_max;
    row.parallel_next = true;
  }
  rows[0].a_mm = rounded(random, 250, 500);
  rows[0].d_mm = rounded(random, 200, 450);
  rows[1].a_mm = rounded(random, 200, 400);
  rows[1].alpha_deg = 180.0;
  rows[2].type = JointType::kPrismatic;
  rows[2].q_min = rounded(random, 0, 50);
  rows[2].q_max = rounded(random, 180, 350);
  rows[3].d_mm = rounded(random, 30, 80);
  rows[3].parallel_next = false;
  return rows;
}

// Converts the rows to Craig's convention: each link moves to the row of the joint that it leads
// to.
void to_modified(std::vector<SheetRow>& rows) {
  for (std::size_t i = rows.size() - 1; i > 0; --i) {
    rows[i].a_mm = rows[i - 1].a_mm;
    rows[i].alpha_deg = rows[i - 1].alpha_deg;
  }
  rows[0].a_mm = 0.0;
  rows[0].alpha_deg = 0.0;
}

}  // namespace

Cell random_cell(std::uint64_t seed, int joints, Convention convention, ArmKind kind) {
  const bool scara = kind == ArmKind::kScara;
  if (joints < kMinJoints || joints > kMaxJoints || (scara && joints != kMinJoints)) {
    throw std::invalid_argument("random_cell: 4 to 7 joints, a SCARA has 4; got " +
                                std::to_string(joints));
  }
  Random random(seed, scara ? "random scara" : "random arm");
  auto rows = scara ? scara_rows(random) : revolute_rows(joints, random);
  if (convention == Convention::kModified) to_modified(rows);
  Cell cell = sim::cell_from_sheet(convention, rows, rounded(random, 100, 200));
  cell.name = "Random arm " + std::to_string(seed);
  cell.serial = "RANDOM-" + std::to_string(seed);
  cell.robot_name = cell.name;
  return cell;
}

}  // namespace plumb::offline
