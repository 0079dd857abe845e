// SPDX-License-Identifier: Apache-2.0
#include "fit/placement.hpp"

#include <algorithm>
#include <cmath>

#include "fit/frame_start.hpp"
#include "fit/parameter_subset.hpp"

namespace plumb::offline {
namespace {

constexpr int kStartPoses = 500;           // enough to find the start
constexpr double kSuspiciousStart = 0.02;  // of the reach: the start may be wrong
constexpr double kPlacingShare = 1e-9;     // frame and target are held only if truly without effect

double rms(const Eigen::VectorXd& v) {
  return v.size() > 0 ? std::sqrt(v.squaredNorm() / static_cast<double>(v.size())) : 0.0;
}

/// Frame and target alone, from a given turn of the frame.
Solution place_from(const FitData& data, ArmState state, const std::vector<Parameter>& placing) {
  if (data.sigma_rad > 0.0) state.X_TG.q = align_target(state, *data.measured, data.rows);
  const auto subset =
      identifiable_parameters(data, state, placing, {.min_independent_share = kPlacingShare});
  return solve(data, state, subset.kept);
}

/// Turns of a cube: starts that leave no frame farther than 63 degrees away.
std::vector<Matrix3> cube_turns() {
  std::vector<Matrix3> out;
  for (int face = 0; face < 6; ++face)
    for (int quarter = 0; quarter < 4; ++quarter) {
      const Transformd turn = face < 4 ? rot_x(M_PI_2 * face) : rot_y(face == 4 ? M_PI_2 : -M_PI_2);
      out.push_back(turn.R * rot_z(M_PI_2 * quarter).R);
    }
  return out;
}

format::Pose aligned_frame(const FitData& data, ArmState state) {
  const Measurements some = pick(*data.measured, data.rows);
  state.X_MB = format::Pose{};
  return align(predict_points(state, some.q), some.p_M);
}

}  // namespace

Solution place(const FitData& data, const ArmState& nominal,
               const std::vector<Parameter>& candidates) {
  std::vector<Parameter> placing;
  std::copy_if(candidates.begin(), candidates.end(), std::back_inserter(placing),
               [](const Parameter& p) { return !p.of_robot(); });
  const bool frame_is_free = std::any_of(placing.begin(), placing.end(), [](const Parameter& p) {
    return p.kind == Parameter::Kind::kFrame;
  });
  FitData thin = data;
  thin.rows = thinned(data.rows, kStartPoses);
  ArmState state = nominal;
  if (frame_is_free) state.X_MB = aligned_frame(thin, state);
  Solution best = place_from(thin, state, placing);
  const double sigma = data.sigma_m.row(thin.rows.front()).mean();
  const double suspicious = kSuspiciousStart * reach(nominal.arm.calibrated);
  if (frame_is_free && rms(best.residual) * sigma > suspicious) {
    for (const Matrix3& turn : cube_turns()) {
      state.X_MB = to_pose({turn, from_pose(best.state.X_MB).p});
      Solution other = place_from(thin, state, placing);
      if (other.cost < best.cost) best = std::move(other);
    }
  }
  return place_from(data, best.state, placing);
}

}  // namespace plumb::offline
