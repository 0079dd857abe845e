// SPDX-License-Identifier: Apache-2.0
#include "noise/repeatability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "arm/arm_change.hpp"
#include "noise/constants.hpp"
#include "noise/weights.hpp"
#include "solve/evaluation.hpp"
#include "solve/orthonormal.hpp"

namespace plumb::offline {
namespace {

/// The offset of each joint: the derivatives by the offsets are the motions of the joints.
std::vector<Parameter> joint_offsets(const format::Chain& chain) {
  std::vector<Parameter> out;
  for (const auto& joint : chain.joints) {
    const bool turns = joint.type == format::JointType::kRevolute;
    if (const auto p = robot_parameter(chain, joint.name + (turns ? ".theta" : ".d")))
      out.push_back(*p);
  }
  return out;
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

constexpr std::size_t kReadingsInOneGo = 512;

/// The lines of a calibrated model at some readings, computed in blocks that fit into the cache.
class ModelLines {
 public:
  ModelLines(const Measurements& measured, const ArmState& state,
             const std::vector<Parameter>& fitted, Rows3 sigma_m, const std::vector<int>& rows)
      : state_(state),
        fitted_(fitted),
        offsets_(joint_offsets(state.arm.calibrated)),
        rows_(rows),
        stops_(stops(measured, rows)) {
    data_.measured = &measured;
    data_.sigma_m = std::move(sigma_m);
  }

  /// Lines of the chosen readings, reading by reading.
  ScatterLines readings(const std::vector<std::size_t>& chosen) {
    data_.rows.clear();
    for (const std::size_t i : chosen) data_.rows.push_back(rows_[i]);
    Solution model = evaluate(data_, state_, fitted_);
    const Solution joints = evaluate(data_, state_, offsets_);
    ScatterLines out{std::move(model.residual), std::move(model.jacobian), {}, data_.line_table()};
    for (const auto motion : joints.jacobian.colwise()) out.joint.emplace_back(motion);
    return out;
  }

  ScatterLines merged(const ScatterLines& lines, const std::vector<std::size_t>& chosen) const {
    std::vector<int> stop;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      const bool same = i > 0 && stops_[chosen[i]] == stops_[chosen[i - 1]];
      stop.push_back(i == 0 ? 0 : stop.back() + (same ? 0 : 1));
    }
    return by_stop(lines, stop);
  }

  /// The readings of the stops from which the scatter is estimated.
  std::vector<std::size_t> some() const {
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (is_among(stops_[i], stops_.back() + 1, kPosesOfScatter)) out.push_back(i);
    return out;
  }

  /// Calls visit(indices of readings) for blocks of readings; a stop is never split.
  template <class Visit>
  void in_blocks(const Visit& visit) const {
    std::vector<std::size_t> block;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const bool new_stop = i > 0 && stops_[i] != stops_[i - 1];
      if (new_stop && block.size() >= kReadingsInOneGo) visit(std::exchange(block, {}));
      block.push_back(i);
    }
    if (!block.empty()) visit(block);
  }

  double mean_square_sigma() const {
    double sum = 0.0, lines = 0.0;
    in_blocks([&](const std::vector<std::size_t>& block) {
      const std::vector<double> sigma = sigma_m(block);
      for (const double s : sigma) sum += s * s;
      lines += static_cast<double>(sigma.size());
    });
    return sum / std::max(1.0, lines);
  }

  /// 1 sigma by which the lines of these readings were divided [m].
  std::vector<double> sigma_m(const std::vector<std::size_t>& chosen) const {
    std::vector<double> out;
    for (const std::size_t i : chosen)
      for (int k = 0; k < 3; ++k)
        if (data_.measured->has_axis[k]) out.push_back(data_.sigma_m(rows_[i], k));
    return out;
  }

 private:
  const ArmState& state_;
  const std::vector<Parameter>& fitted_;
  const std::vector<Parameter> offsets_;
  const std::vector<int>& rows_;
  const std::vector<int> stops_;
  FitData data_;
};

/// Sets the prior of the variance of the lines from the noise floor; mean_square_m2: of the sigmas
/// by which the lines were divided.
void tell(const NoiseFloor& floor, double mean_square_m2, ScatterLines& lines) {
  if (floor.source == NoiseFloor::Source::kNone) return;
  lines.noise_variance = floor.sigma_m * floor.sigma_m / mean_square_m2;
  lines.noise_dof = trusted_dof(floor);
}

}  // namespace

bool Repeatability::supported() const { return nats > kScatterSupported_nats && usual(); }

bool Repeatability::usual() const {
  return sigma_m <= usual_sigma_m &&
         std::all_of(std.begin(), std.end(), [](double joint) { return joint <= kMostOfJoint; });
}

void SquaredMotions::add(const ScatterLines& lines, const std::vector<double>& sigma_m) {
  joint_.resize(lines.joint.size(), 0.0);
  for (const double sigma : sigma_m) sigma_ += sigma * sigma;
  for (std::size_t j = 0; j < joint_.size(); ++j)
    for (std::size_t i = 0; i < sigma_m.size(); ++i)
      joint_[j] += std::pow(lines.joint[j](static_cast<Eigen::Index>(i)) * sigma_m[i], 2);
  lines_ += static_cast<double>(sigma_m.size());
}

Repeatability SquaredMotions::with(const JointScatter& scatter) const {
  const double lines = std::max(1.0, lines_);
  Repeatability out;
  double variance = scatter.noise_variance * sigma_ / lines, usual = variance;
  for (std::size_t j = 0; j < joint_.size(); ++j) {
    const double joint = scatter.variance(static_cast<Eigen::Index>(j));
    out.std.push_back(std::sqrt(joint));
    variance += joint * joint_[j] / lines;
    usual += kUsualScatter_rad * kUsualScatter_rad * joint_[j] / lines;
  }
  out.usual_sigma_m = std::sqrt(usual);
  out.sigma_m = std::sqrt(variance);
  return out;
}

Repeatability repeatability(const Cell& cell, const Measurements& measured, const ArmState& state,
                            const std::vector<Parameter>& fitted, const std::vector<int>& rows) {
  if (rows.empty()) return {};
  ModelLines model(measured, state, fitted, stated_sigma(cell, measured), rows);
  SquaredMotions motions;
  const auto chosen = model.some();
  ScatterLines some = model.merged(model.readings(chosen), chosen);
  const Eigen::MatrixXd half = orthonormal(some.U, some.U.rows()).half;
  some.U *= half;
  tell(noise_floor(cell, measured, state), model.mean_square_sigma(), some);
  const JointScatter scatter = noise_and_scatter(some);
  ScatterSums white, scattered;
  model.in_blocks([&](const std::vector<std::size_t>& block) {
    const ScatterLines lines = model.readings(block);
    motions.add(lines, model.sigma_m(block));
    ScatterLines merged = model.merged(lines, block);
    merged.U *= half;
    white.add(merged, unit_noise(merged));
    scattered.add(merged, scatter);
  });
  const double noise = noise_alone(white, some).noise_variance;
  Repeatability out = motions.with(scatter);
  out.nats = ln_likelihood_of_ratios(scattered, some.noise_dof) -
             ln_likelihood_of_ratios(white.with_noise(noise), some.noise_dof) -
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
  std::vector<double> readings(static_cast<std::size_t>(stops.back() + 1), 0.0);
  std::vector<Eigen::Index> first;  // reading of each stop
  for (std::size_t i = 0; i < stops.size(); ++i) {
    if (readings[static_cast<std::size_t>(stops[i])] == 0.0)
      first.push_back(static_cast<Eigen::Index>(i));
    readings[static_cast<std::size_t>(stops[i])] += 1.0;
  }
  const LineTable table = s.table.picked(first);
  const auto added = [&](const Eigen::MatrixXd& lines) {
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(table.lines(), lines.cols());
    for (std::size_t i = 0; i < stops.size(); ++i)
      out.middleRows(table.begin(stops[i]), table.count(stops[i])) +=
          lines.middleRows(s.table.begin(static_cast<Eigen::Index>(i)), table.count(stops[i])) /
          std::sqrt(readings[static_cast<std::size_t>(stops[i])]);
    return out;
  };
  ScatterLines out{added(s.y), added(s.U), {}, table, s.noise_variance, s.noise_dof};
  for (const auto& motion : s.joint) out.joint.emplace_back(added(motion));
  return out;
}

}  // namespace plumb::offline
