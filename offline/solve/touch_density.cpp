// SPDX-License-Identifier: Apache-2.0
#include "solve/touch_density.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "arm/arm_change.hpp"
#include "plumb/runtime/chain.hpp"

namespace plumb::offline {
namespace {

constexpr std::size_t kMostRows = 300;
constexpr double kStep = 1e-5;  // of the differences [m, rad]
/// Added to J J^T, for arms that do not move in all directions. Chosen: far below any motion of the
/// target by a radian.
constexpr double kLeastMotion_m = 1e-4;

/// Mean over the rows of the logarithm of the third root of sqrt(det(J J^T)).
double mean_log_volume(const Measurements& measured, const std::vector<int>& rows,
                       const ArmState& state) {
  const Chain chain(state.arm.calibrated);
  ChainFrames frames;
  double sum = 0.0;
  for (const int row : rows) {
    chain.frames({measured.q.row(row).data(), static_cast<std::size_t>(measured.q.cols())}, frames);
    const Vector3 target =
        frames.tip.p + frames.tip.R * from_pose(state.target(setup_of(measured, row))).p;
    Matrix3 volume = kLeastMotion_m * kLeastMotion_m * Matrix3::Identity();
    for (int j = 0; j < chain.joints(); ++j) {
      const auto& joint = frames.joint[static_cast<std::size_t>(j)];
      const Vector3 axis = joint.R.col(2) * chain.scale(j);
      const Vector3 motion = chain.revolute(j) ? cross<double>(axis, target - joint.p) : axis;
      volume += motion * motion.transpose();
    }
    sum += std::log(volume.determinant()) / 6.0;
  }
  return sum / static_cast<double>(rows.size());
}

std::vector<int> touching(const Measurements& measured, const std::vector<int>& rows) {
  std::vector<int> all, out;
  for (const int row : rows)
    if (measured.touches_point(row)) all.push_back(row);
  const std::size_t count = std::min(all.size(), kMostRows);
  for (std::size_t i = 0; i < count; ++i) out.push_back(all[i * all.size() / count]);
  return out;
}

}  // namespace

double TouchDensity::times(const ArmState& state) const {
  double out = 1.0;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto at_i = static_cast<Eigen::Index>(i);
    out += slopes(at_i) * (value_of(state, parameters[i]) - at(at_i));
  }
  return std::max(out, 0.1);  // the line ends where an arm would have no size left
}

Eigen::RowVectorXd TouchDensity::slopes_of(const std::vector<Parameter>& others) const {
  Eigen::RowVectorXd out = Eigen::RowVectorXd::Zero(static_cast<Eigen::Index>(others.size()));
  for (std::size_t k = 0; k < others.size(); ++k)
    for (std::size_t i = 0; i < parameters.size(); ++i)
      if (parameters[i].name == others[k].name)
        out(static_cast<Eigen::Index>(k)) = slopes(static_cast<Eigen::Index>(i));
  return out;
}

TouchDensity touch_density(const Measurements& measured, const std::vector<int>& rows,
                           const ArmState& state, const std::vector<Parameter>& parameters) {
  TouchDensity out;
  const std::vector<int> some = touching(measured, rows);
  if (some.empty()) return out;
  for (const auto& p : parameters)
    if (!p.of_effect() && !p.of_base() && p.kind != Parameter::Kind::kTargetRotation)
      out.parameters.push_back(p);
  const auto count = static_cast<Eigen::Index>(out.parameters.size());
  out.slopes.resize(count);
  out.at.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const std::vector<Parameter> one{out.parameters[static_cast<std::size_t>(i)]};
    const auto volume = [&](double step) {
      return mean_log_volume(measured, some, moved(state, one, Eigen::VectorXd::Constant(1, step)));
    };
    out.slopes(i) = (volume(kStep) - volume(-kStep)) / (2.0 * kStep);
    out.at(i) = value_of(state, one.front());
  }
  return out;
}

}  // namespace plumb::offline
