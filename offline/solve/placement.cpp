// SPDX-License-Identifier: Apache-2.0
#include "solve/placement.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>

#include "arm/predicted_points.hpp"
#include "solve/artefact_start.hpp"
#include "solve/constants.hpp"
#include "solve/frame_start.hpp"
#include "solve/parameter_subset.hpp"
#include "solve/solver.hpp"
#include "solve/thinned_rows.hpp"

namespace plumb::offline {
namespace {

/// Independent share of a column below which a number of frame or target is held: only if it has
/// no effect beyond rounding.
constexpr double kPlacingShare = 1e-9;

double rms(const Eigen::VectorXd& v) {
  return v.size() > 0 ? std::sqrt(v.squaredNorm() / static_cast<double>(v.size())) : 0.0;
}

Solution solve_placing(const FitData& data, const ArmState& state,
                       const std::vector<Parameter>& placing) {
  const auto subset =
      identifiable_parameters(data, state, placing, {.min_independent_share = kPlacingShare});
  return solve(data, state, subset.kept);
}

bool has_kind(const std::vector<Parameter>& placing, Parameter::Kind kind) {
  return std::any_of(placing.begin(), placing.end(),
                     [&](const Parameter& p) { return p.kind == kind; });
}

/// Fits frame and target of one set-up alone, starting from the frame that `state` has.
Solution place_from(const FitData& data, ArmState state, const std::vector<Parameter>& placing,
                    int setup) {
  // Keep the target rotation if an earlier set-up has already estimated it.
  if (data.sigma_rad > 0.0 && state.target_of(setup) == setup)
    state.target(setup).q = align_target(state, *data.measured, data.rows);
  return solve_placing(data, state, placing);
}

/// The 24 rotations of a cube. No rotation is farther than 63 degrees from the nearest of them.
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

FitData fewer(const FitData& data, int most) {
  FitData out = data;
  out.rows = thinned(data, most);
  return out;
}

struct PointPairs {
  Rows3 p_B, p_M;  // predicted by the nominal arm, and measured
};

PointPairs points_of(const FitData& data, ArmState state, int setup) {
  const Measurements some = pick(*data.measured, data.rows);
  state.frame(setup) = format::Pose{};
  return {predict_points(state, some), some.p_M};
}

/// Standard deviation of the points across the line that they lie along.
double spread_across(const Rows3& points) {
  const Rows3 centred = points.rowwise() - points.colwise().mean();
  const Matrix3 scatter = centred.transpose() * centred / static_cast<double>(points.rows());
  const Vector3 squares = Eigen::SelfAdjointEigenSolver<Matrix3>(scatter).eigenvalues();
  return std::sqrt(std::max(0.0, squares(1)));
}

/// Whether a placement may be the wrong minimum. Of points along a line it is so at a far smaller
/// error than else: the frame turned the wrong way about the line moves none of them by much more
/// than they lie beside it.
bool looks_wrong(const FitData& data, const Solution& solution, const ArmState& nominal,
                 const PointPairs& points) {
  const double sigma = data.sigma_m.row(data.rows.front()).mean();
  const double limit =
      std::min(kSuspiciousStart * reach(nominal.arm.calibrated),
               kSuspiciousShare * std::max(spread_across(points.p_B), spread_across(points.p_M)));
  return rms(solution.residual) * sigma > limit;
}

/// Adds `more` to `found`; if that minimum is there already, the one of lower cost stays.
void join(std::vector<Solution>& found, Solution more) {
  for (auto& one : found)
    if (turn_between(one.state, more.state) < kSameTurn_rad) {
      if (more.cost < one.cost) one = std::move(more);
      return;
    }
  found.push_back(std::move(more));
}

/// Minima of frame and target. The starts are the rotations of a cube, shifted so that the centroid
/// of the predicted points falls on that of the measured ones.
std::vector<Solution> turned_placements(const FitData& data, const ArmState& from,
                                        const PointPairs& points,
                                        const std::vector<Parameter>& placing, int setup) {
  const Vector3 mean_B = points.p_B.colwise().mean();
  const Vector3 mean_M = points.p_M.colwise().mean();
  std::vector<Solution> found;
  for (const Matrix3& turn : cube_turns()) {
    ArmState state = from;
    state.frame(setup) = to_pose({turn, mean_M - turn * mean_B});
    join(found, place_from(data, state, placing, setup));
  }
  return found;
}

/// Sorts by cost, and drops those that are much worse than the best or too many.
void keep_likely(std::vector<Solution>& found) {
  std::sort(found.begin(), found.end(),
            [](const Solution& a, const Solution& b) { return a.cost < b.cost; });
  const double most = kNotMuchWorse * found.front().cost;
  std::erase_if(found, [&](const Solution& s) { return s.cost > most; });
  if (found.size() > kMostPlacements) found.resize(kMostPlacements);
}

/// The placements of one set-up, to which all rows of `data` belong.
std::vector<Solution> placements_of(const FitData& data, const ArmState& nominal,
                                    const std::vector<Parameter>& placing, int setup) {
  if (has_kind(placing, Parameter::Kind::kPlane) || has_kind(placing, Parameter::Kind::kPoint))
    return {placed_artefact(
        data, nominal, setup, has_kind(placing, Parameter::Kind::kArtefactLength),
        [&](const ArmState& start) { return place_from(data, start, placing, setup); })};
  if (!has_kind(placing, Parameter::Kind::kFrame))
    return {place_from(data, nominal, placing, setup)};
  const FitData thin = fewer(data, kStartPoses);
  ArmState start = nominal;
  const PointPairs points = points_of(thin, nominal, setup);
  start.frame(setup) = align(points.p_B, points.p_M);
  std::vector<Solution> found;
  found.push_back(place_from(thin, start, placing, setup));
  if (looks_wrong(thin, found.front(), nominal, points)) {
    const FitData few = fewer(data, kTurnPoses);
    for (auto& other :
         turned_placements(few, start, points_of(few, nominal, setup), placing, setup))
      join(found, place_from(thin, other.state, placing, setup));
  }
  keep_likely(found);
  for (auto& one : found) one = place_from(data, one.state, placing, setup);
  return found;
}

FitData rows_of(const FitData& data, int setup) {
  FitData out = data;
  std::erase_if(out.rows, [&](int row) { return setup_of(*data.measured, row) != setup; });
  return out;
}

/// Places set-up after set-up, each starting from every placement found of those before it, and
/// then fits all of them together.
std::vector<Solution> placements_of_all(const FitData& data, const ArmState& nominal,
                                        const std::vector<Parameter>& placing) {
  std::vector<Solution> found(1);
  found.front().state = nominal;
  for (int k = 0; k < nominal.setups(); ++k) {
    const FitData part = rows_of(data, k);
    if (part.rows.empty()) continue;
    std::vector<Parameter> own;
    std::copy_if(placing.begin(), placing.end(), std::back_inserter(own),
                 [&](const Parameter& p) { return p.setup == k; });
    std::vector<Solution> longer;
    for (const auto& before : found)
      for (auto& one : placements_of(part, before.state, own, k)) {
        one.cost += before.cost;
        longer.push_back(std::move(one));
      }
    keep_likely(longer);
    found = std::move(longer);
  }
  for (auto& one : found) one = solve_placing(data, one.state, placing);
  keep_likely(found);
  return found;
}

}  // namespace

double turn_between(const ArmState& a, const ArmState& b) {
  double most = 0.0;
  for (int k = 0; k < a.setups(); ++k) {
    const Matrix3 turn = from_pose(a.frame(k)).R.transpose() * from_pose(b.frame(k)).R;
    most = std::max(most, rotation_vector(turn).norm());
  }
  return most;
}

Problem ambiguous_frame(const ArmState& best, const ArmState& other) {
  return {.severity = Severity::kWarning,
          .code = "W-FIT-AMBIGUOUS",
          .message = fmt::format("a tracker frame turned by {:.0f} deg fits these poses almost as "
                                 "well: which one is true stays open",
                                 turn_between(best, other) * 180.0 / M_PI),
          .help = "state the frame: [measurement] frame = { xyz, rpy }, or measure other poses"};
}

std::vector<Solution> placements(const FitData& data, const ArmState& nominal,
                                 const std::vector<Parameter>& candidates) {
  const auto placing = placing_of(candidates);
  if (nominal.setups() > 1) return placements_of_all(data, nominal, placing);
  return placements_of(data, nominal, placing, 0);
}

Solution place(const FitData& data, const ArmState& nominal,
               const std::vector<Parameter>& candidates) {
  return placements(data, nominal, candidates).front();
}

}  // namespace plumb::offline
