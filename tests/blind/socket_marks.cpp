// SPDX-License-Identifier: Apache-2.0
#include "tests/blind/socket_marks.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <filesystem>
#include <numeric>

#include "arm/predicted_points.hpp"
#include "fit/calibrate.hpp"
#include "fit/cell_data.hpp"
#include "numbers/tails.hpp"
#include "tests/cell/support.hpp"

namespace plumb::offline {
namespace {

constexpr int kSockets = 10, kArtefacts = 5;

/// Where a tracker sees the ball at random joints.
std::string tracker_csv(SocketArm& arm, const SocketWay& way) {
  std::string out = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm\n";
  for (int i = 0; i < way.readings; ++i) {
    const SocketArm::Joints q = arm.random_joints();
    for (const double angle : q) out += fmt::format("{:.7f},", angle * 180.0 / M_PI);
    const Eigen::Vector3d p = arm.ball(q) + arm.noise(way.sigma_m);
    out += fmt::format("{:.6f},{:.6f},{:.6f}\n", p.x() * 1e3, p.y() * 1e3, p.z() * 1e3);
  }
  return out;
}

std::string csv_of(SocketArm& arm, const SocketWay& way) {
  switch (way.kind) {
    case SocketWay::Kind::kTracker:
      return tracker_csv(arm, way);
    case SocketWay::Kind::kArtefacts:
      return artefact_readings(arm, {.kind = way.artefacts,
                                     .artefacts = kArtefacts,
                                     .readings = way.readings / kArtefacts,
                                     .sigma_m = way.sigma_m});
    default:
      return arm.measurements_csv();
  }
}

}  // namespace

SocketPlan plan_of(const SocketWay& way, std::uint64_t seed) {
  SocketPlan out;
  out.seed = seed;
  const bool sockets =
      way.kind == SocketWay::Kind::kSockets || way.kind == SocketWay::Kind::kKnownDistance;
  out.placements = sockets ? kSockets / 2 : 1;
  out.touches = sockets ? way.readings / kSockets : 2;
  out.play_m = way.sigma_m;
  out.known_distance = way.kind == SocketWay::Kind::kKnownDistance;
  return out;
}

SocketCell read_way(SocketArm& arm, const SocketWay& way) {
  const Folder folder;
  const auto file = folder.put("cell.toml", arm.cell_toml());
  folder.put("measurements.csv", csv_of(arm, way));
  SocketCell out;
  out.cell = read_cell(file);
  out.cell.measurement.sigma_m = way.sigma_m;
  out.measured = read_cell_measurements(out.cell);
  return out;
}

std::string name_of(const SocketWay& way) {
  switch (way.kind) {
    case SocketWay::Kind::kTracker:
      return "tracker";
    case SocketWay::Kind::kKnownDistance:
      return "sockets, known distance";
    case SocketWay::Kind::kArtefacts:
      return std::array{"planes",
                        "heights above planes",
                        "ball bar of unknown length",
                        "ball bar, known length",
                        "distances to anchors",
                        "wires of unknown zero"}[static_cast<std::size_t>(way.artefacts)];
    default:
      return "sockets";
  }
}

namespace {

double fresh_error(SocketArm& arm, const ArmState& state) {
  return arm.error_at_fresh_joints([&](const SocketArm::Joints& q) {
    Measurements one;
    one.q = Eigen::Map<const Eigen::RowVectorXd>(q.data(), 6);
    return Eigen::Vector3d(predict_points(state, one).row(0).transpose());
  });
}

/// The true value of "J3.a"; not a number for names of nothing that the simulated arm has.
double true_value(const SocketArm& arm, const std::string& name) {
  const auto joint = static_cast<std::size_t>(name[1] - '1');
  const std::string what = name.substr(3);
  if (name[0] != 'J' || joint >= 6) return NAN;
  const char* const names[] = {"theta", "d", "a", "alpha"};
  for (std::size_t k = 0; k < 4; ++k)
    if (what == names[k]) return arm.rows()[joint][k];
  return what == "beta" ? 0.0 : NAN;
}

void judge(const SocketWay& way, std::uint64_t seed, SocketMarks& out) {
  SocketArm arm(plan_of(way, seed));
  const auto [cell, measured] = read_way(arm, way);
  std::vector<int> rows(static_cast<std::size_t>(measured.size()));
  std::iota(rows.begin(), rows.end(), 0);
  try {
    const Calibration c = calibrate(cell, measured, rows);
    out.errors_m.push_back(fresh_error(arm, c.state));
    for (const Estimate& e : c.estimates) {
      const double truth = true_value(arm, e.name);
      if (!e.of_robot || std::isnan(truth)) continue;
      ++out.numbers;
      if (std::abs(e.value - truth) <= kNormal95 * e.std) ++out.inside;
    }
  } catch (const Failure& failure) {
    if (failure.exit_code() != Exit::kNumbersSayNo) throw;
    ++out.refused;
  }
}

}  // namespace

double SocketMarks::mean_m() const {
  return std::accumulate(errors_m.begin(), errors_m.end(), 0.0) /
         std::max(1.0, static_cast<double>(errors_m.size()));
}

SocketMarks socket_marks(const SocketWay& way, int arms, std::uint64_t seed) {
  SocketMarks out;
  out.way = way;
  for (int k = 0; k < arms; ++k) judge(way, seed + static_cast<std::uint64_t>(k), out);
  return out;
}

std::string socket_table(const std::vector<SocketMarks>& all) {
  std::string out =
      "| measured by | 1 sigma [µm] | readings | error at fresh joints [mm] | numbers inside their "
      "95 % interval | not calibrated |\n|---|---|---|---|---|---|\n";
  for (const SocketMarks& m : all) {
    out +=
        fmt::format("| {} | {:.0f} | {} | {:.3f} | {:.1f} % | {} of {} |\n", name_of(m.way),
                    m.way.sigma_m * 1e6, m.way.readings, m.mean_m() * 1e3, 100.0 * m.inside_share(),
                    m.refused, m.refused + static_cast<int>(m.errors_m.size()));
  }
  return out;
}

}  // namespace plumb::offline
