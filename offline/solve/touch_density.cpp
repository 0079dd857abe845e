// SPDX-License-Identifier: Apache-2.0
#include "solve/touch_density.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "arm/arm_change.hpp"
#include "observe/reading.hpp"
#include "plumb/runtime/chain.hpp"

namespace plumb::offline {
namespace {

constexpr std::size_t kMostRows = 300;
constexpr double kStep = 1e-6;         // of the differences [m, rad]
constexpr double kHomogeneous = 1e-4;  // more is a length that is held, not rounding
/// Added to J J^T, for arms that do not move in all directions. Chosen: far below any motion of the
/// target by a radian.
constexpr double kLeastMotion_m = 1e-4;

/// The logarithm of sqrt(det(J J^T)) of each touch, divided by the number of all their lines.
double mean_log_volume(const Measurements& measured, const std::vector<int>& rows,
                       const ArmState& state) {
  const Chain chain(state.arm.calibrated);
  ChainFrames frames;
  double sum = 0.0;
  int lines = 0;
  for (const int row : rows) {
    chain.frames({measured.q.row(row).data(), static_cast<std::size_t>(measured.q.cols())}, frames);
    const int setup = setup_of(measured, row);
    const Transformd X_MB = from_pose(state.frame(setup));
    const Vector3 target = frames.tip.p + frames.tip.R * from_pose(state.target(setup)).p;
    const Reading reading(measured, row, false);
    const Vector3 p_M = X_MB * target;
    Eigen::MatrixXd J(reading.lines(), chain.joints());
    for (int j = 0; j < chain.joints(); ++j) {
      const auto& joint = frames.joint[static_cast<std::size_t>(j)];
      const Vector3 axis = joint.R.col(2) * chain.scale(j);
      const Vector3 motion = chain.revolute(j) ? cross<double>(axis, target - joint.p) : axis;
      reading.project(p_M, X_MB.R * motion, Vector3::Zero(), J.col(j));
    }
    const Eigen::MatrixXd least =
        kLeastMotion_m * kLeastMotion_m * Eigen::MatrixXd::Identity(J.rows(), J.rows());
    sum += 0.5 * std::log((J * J.transpose() + least).determinant());
    lines += reading.lines();
  }
  return sum / lines;
}

/// Whether the volume of some touches depends on the number: on all of the arm and the target, and
/// on how a plane lies and where the centre of a sphere is, for the volume is that across a
/// surface.
bool changes_volume(const Measurements& measured, const std::vector<int>& rows,
                    const Parameter& p) {
  using Kind = Parameter::Kind;
  if (p.of_effect() || p.kind == Kind::kTargetRotation) return false;
  if (!p.of_base()) return true;
  if (p.kind != Kind::kPlane && p.kind != Kind::kPoint) return false;
  return std::any_of(rows.begin(), rows.end(), [&](int row) {
    return setup_of(measured, row) == p.setup && measured.kind_of(row) != ReadingKind::kPoint;
  });
}

std::vector<int> touching(const Measurements& measured, const std::vector<int>& rows) {
  std::vector<int> all, out;
  for (const int row : rows)
    if (is_touch(measured.kind_of(row))) all.push_back(row);
  const std::size_t count = std::min(all.size(), kMostRows);
  for (std::size_t i = 0; i < count; ++i) out.push_back(all[i * all.size() / count]);
  return out;
}

/// The root grows as the arm does: where all lengths are among the parameters, the slopes times the
/// lengths add up to 1. Rounding of the differences would hide that the size of the arm is open.
void grow_exactly(TouchDensity& density) {
  double sum = 0.0;
  for (std::size_t i = 0; i < density.parameters.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    if (density.parameters[i].is_length()) sum += density.slopes(k) * density.at(k);
  }
  if (std::abs(sum - 1.0) > kHomogeneous) return;
  for (std::size_t i = 0; i < density.parameters.size(); ++i)
    if (density.parameters[i].is_length()) density.slopes(static_cast<Eigen::Index>(i)) /= sum;
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
    if (changes_volume(measured, some, p)) out.parameters.push_back(p);
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
  grow_exactly(out);
  return out;
}

}  // namespace plumb::offline
