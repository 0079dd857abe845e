// SPDX-License-Identifier: Apache-2.0
#include "fit/repeatability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fit/arm_change.hpp"
#include "fit/orthonormal.hpp"
#include "fit/solver.hpp"
#include "fit/weights.hpp"

namespace plumb::offline {
namespace {

constexpr double kSupported_nats = 3.0;  // 20 to 1
constexpr double kUsual_rad = 60e-6;     // [m] of a joint that slides
constexpr double kMostOfJoint = 200e-6;  // [rad or m] no industrial arm has more
constexpr double kWorthSaying = 0.3;     // of the largest

/// The offset of each joint, whose derivative is the motion of the joint.
std::vector<Parameter> joint_offsets(const format::Chain& chain) {
  std::vector<Parameter> out;
  for (const auto& joint : chain.joints) {
    const bool turns = joint.type == format::JointType::kRevolute;
    if (const auto p = robot_parameter(chain, joint.name + (turns ? ".theta" : ".d")))
      out.push_back(*p);
  }
  return out;
}

double mean_square(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v * v;
  return sum / static_cast<double>(std::max<std::size_t>(1, values.size()));
}

bool same_or_both_nan(double a, double b) { return a == b || (a != a && b != b); }

bool same_row(const RowsN& values, int a, int b) {
  for (Eigen::Index k = 0; k < values.cols(); ++k)
    if (!same_or_both_nan(values(a, k), values(b, k))) return false;
  return true;
}

bool stood_still(const Measurements& m, int a, int b) {
  if (b != a + 1 || m.replicate_group[a] != m.replicate_group[b]) return false;
  const ContextRows& c = m.context;
  return (c.payload.rows() == 0 || same_row(c.payload, a, b)) &&
         (c.direction.rows() == 0 || same_row(c.direction, a, b));
}

}  // namespace

bool Repeatability::supported() const { return nats > kSupported_nats && usual(); }

bool Repeatability::usual() const {
  return sigma_m <= usual_sigma_m &&
         std::all_of(std.begin(), std.end(), [](double joint) { return joint <= kMostOfJoint; });
}

Repeatability repeatability_of(const ScatterLines& lines, const JointScatter& scatter,
                               const std::vector<double>& sigma_m) {
  Repeatability out;
  double variance = scatter.noise_variance * mean_square(sigma_m), usual = variance;
  for (std::size_t j = 0; j < lines.joint.size(); ++j) {
    const double joint = scatter.variance(static_cast<Eigen::Index>(j));
    out.std.push_back(std::sqrt(joint));
    double moved = 0.0;
    for (std::size_t i = 0; i < sigma_m.size(); ++i)
      moved += std::pow(lines.joint[j](static_cast<Eigen::Index>(i)) * sigma_m[i], 2);
    moved /= static_cast<double>(std::max<std::size_t>(1, sigma_m.size()));
    variance += joint * moved;
    usual += kUsual_rad * kUsual_rad * moved;
  }
  out.usual_sigma_m = std::sqrt(usual);
  out.sigma_m = std::sqrt(variance);
  return out;
}

Repeatability repeatability(const Cell& cell, const Measurements& measured,
                            const Calibration& calibration, const std::vector<int>& rows) {
  FitData data;
  data.measured = &measured;
  data.rows = rows;
  data.sigma_m = stated_sigma(cell, measured);
  const auto offsets = joint_offsets(calibration.state.arm.calibrated);
  const Solution model = evaluate(data, calibration.state, calibration.parameters);
  const Solution joints = evaluate(data, calibration.state, offsets);
  ScatterLines lines;
  lines.axes = data.per_pose();
  lines.y = model.residual;
  lines.U = orthonormal(model.jacobian, model.jacobian.rows()).U;
  for (Eigen::Index j = 0; j < joints.jacobian.cols(); ++j)
    lines.joint.emplace_back(joints.jacobian.col(j));
  std::vector<double> sigma_m;
  for (const int row : rows)
    for (int k = 0; k < 3; ++k)
      if (measured.has_axis[k]) sigma_m.push_back(data.sigma_m(row, k));
  const NoiseFloor floor = noise_floor(cell, measured, calibration.state);
  if (floor.source != NoiseFloor::Source::kNone) {
    lines.noise_variance = floor.sigma_m * floor.sigma_m / mean_square(sigma_m);
    lines.noise_dof = trusted_dof(floor);
  }
  const ScatterLines merged = by_stop(lines, stops(measured, rows));
  const JointScatter scatter = noise_and_scatter(merged);
  Repeatability out = repeatability_of(lines, scatter, sigma_m);
  out.nats = ln_likelihood_of_ratios(merged, scatter) -
             ln_likelihood_of_ratios(merged, noise_alone(merged)) -
             static_cast<double>((scatter.variance.array() > 0.0).count());
  return out;
}

NoiseFloor with_repeatability(NoiseFloor floor, const Repeatability& repeatability) {
  if (floor.source == NoiseFloor::Source::kNone || !repeatability.supported() ||
      !(floor.sigma_m > 0.0) || repeatability.sigma_m <= floor.sigma_m)
    return floor;
  floor.inferred_m = floor.mean_m * repeatability.sigma_m / floor.sigma_m;
  return floor;
}

std::string in_words(const Cell& cell, const Repeatability& r) {
  std::vector<std::size_t> order(r.std.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return r.std[a] > r.std[b]; });
  std::vector<std::string> out;
  for (const std::size_t j : order) {
    if (!(r.std[j] > 0.0) || r.std[j] < kWorthSaying * r.std[order.front()]) continue;
    const bool turns = cell.nominal.joints[j].type == format::JointType::kRevolute;
    out.push_back(fmt::format("{} {:.0f} {}", cell.nominal.joints[j].name, r.std[j] * 1e6,
                              turns ? "µrad" : "µm"));
  }
  return fmt::format("{}", fmt::join(out, ", "));
}

std::vector<int> stops(const Measurements& measured, const std::vector<int>& rows) {
  std::vector<int> out;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool same = i > 0 && stood_still(measured, rows[i - 1], rows[i]);
    out.push_back(i == 0 ? 0 : out.back() + (same ? 0 : 1));
  }
  return out;
}

ScatterLines by_stop(const ScatterLines& s, const std::vector<int>& stops) {
  if (stops.empty()) return s;
  const Eigen::Index count = stops.back() + 1;
  std::vector<double> readings(static_cast<std::size_t>(count), 0.0);
  for (const int stop : stops) readings[static_cast<std::size_t>(stop)] += 1.0;
  const auto added = [&](const Eigen::MatrixXd& lines) {
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(count * s.axes, lines.cols());
    for (std::size_t i = 0; i < stops.size(); ++i)
      out.middleRows(stops[i] * s.axes, s.axes) +=
          lines.middleRows(static_cast<Eigen::Index>(i) * s.axes, s.axes) /
          std::sqrt(readings[static_cast<std::size_t>(stops[i])]);
    return out;
  };
  ScatterLines out{added(s.y), added(s.U), {}, s.axes, s.noise_variance, s.noise_dof};
  for (const auto& motion : s.joint) out.joint.emplace_back(added(motion));
  return out;
}

}  // namespace plumb::offline
