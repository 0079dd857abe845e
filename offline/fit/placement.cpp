// SPDX-License-Identifier: Apache-2.0
#include "fit/placement.hpp"

#include <algorithm>
#include <cmath>

#include "fit/frame_start.hpp"
#include "fit/parameter_subset.hpp"

namespace plumb::offline {
namespace {

constexpr int kStartPoses = 500;            // enough to judge a start
constexpr int kTurnPoses = 60;              // enough to find one
constexpr double kSuspiciousStart = 0.003;  // of the reach: the start may be wrong
constexpr double kPlacingShare = 1e-9;  // frame and target are held only if truly without effect
constexpr double kNotMuchWorse = 9.0;  // times the cost of the best: an arm's errors may reverse it
constexpr std::size_t kMostPlacements = 4;

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

std::vector<Parameter> placing_of(const std::vector<Parameter>& candidates) {
  std::vector<Parameter> out;
  std::copy_if(candidates.begin(), candidates.end(), std::back_inserter(out),
               [](const Parameter& p) { return !p.of_robot(); });
  return out;
}

bool has_frame(const std::vector<Parameter>& placing) {
  return std::any_of(placing.begin(), placing.end(),
                     [](const Parameter& p) { return p.kind == Parameter::Kind::kFrame; });
}

FitData fewer(const FitData& data, int most) {
  FitData out = data;
  out.rows = thinned(data.rows, most);
  return out;
}

struct Points {
  Rows3 p_B, p_M;  // predicted by the nominal arm, and measured
};

Points points_of(const FitData& data, ArmState state) {
  const Measurements some = pick(*data.measured, data.rows);
  state.X_MB = format::Pose{};
  return {predict_points(state, some), some.p_M};
}

bool looks_wrong(const FitData& data, const Solution& solution, const ArmState& nominal) {
  const double sigma = data.sigma_m.row(data.rows.front()).mean();
  return rms(solution.residual) * sigma > kSuspiciousStart * reach(nominal.arm.calibrated);
}

/// `more` joins `found` unless the same minimum is there already.
void join(std::vector<Solution>& found, Solution more) {
  for (auto& one : found)
    if (turn_between(one.state, more.state) < kSameTurn_rad) {
      if (more.cost < one.cost) one = std::move(more);
      return;
    }
  found.push_back(std::move(more));
}

/// Minima of frame and target from every turn of a cube, the centres of the points on each other.
std::vector<Solution> turned_placements(const FitData& data, const ArmState& from,
                                        const Points& points,
                                        const std::vector<Parameter>& placing) {
  const Vector3 mean_B = points.p_B.colwise().mean();
  const Vector3 mean_M = points.p_M.colwise().mean();
  std::vector<Solution> found;
  for (const Matrix3& turn : cube_turns()) {
    ArmState state = from;
    state.X_MB = to_pose({turn, mean_M - turn * mean_B});
    join(found, place_from(data, state, placing));
  }
  return found;
}

}  // namespace

double turn_between(const ArmState& a, const ArmState& b) {
  return rotation_vector(from_pose(a.X_MB).R.transpose() * from_pose(b.X_MB).R).norm();
}

std::vector<Solution> placements(const FitData& data, const ArmState& nominal,
                                 const std::vector<Parameter>& candidates) {
  const auto placing = placing_of(candidates);
  if (!has_frame(placing)) return {place_from(data, nominal, placing)};
  const FitData thin = fewer(data, kStartPoses);
  ArmState start = nominal;
  const Points points = points_of(thin, nominal);
  start.X_MB = align(points.p_B, points.p_M);
  std::vector<Solution> found;
  found.push_back(place_from(thin, start, placing));
  if (looks_wrong(thin, found.front(), nominal)) {
    const FitData few = fewer(data, kTurnPoses);
    for (auto& other : turned_placements(few, start, points_of(few, nominal), placing))
      join(found, place_from(thin, other.state, placing));
  }
  std::sort(found.begin(), found.end(),
            [](const Solution& a, const Solution& b) { return a.cost < b.cost; });
  const double most = kNotMuchWorse * found.front().cost;
  std::erase_if(found, [&](const Solution& s) { return s.cost > most; });
  if (found.size() > kMostPlacements) found.resize(kMostPlacements);
  for (auto& one : found) one = place_from(data, one.state, placing);
  return found;
}

Solution place(const FitData& data, const ArmState& nominal,
               const std::vector<Parameter>& candidates) {
  return placements(data, nominal, candidates).front();
}

}  // namespace plumb::offline
