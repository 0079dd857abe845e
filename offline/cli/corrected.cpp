// SPDX-License-Identifier: Apache-2.0
#include "cli/corrected.hpp"

namespace plumb::offline::cli {
namespace {

constexpr double kNothing_m = 1e-9, kNothing_rad = 1e-9;  // smaller corrections count as none

/// The desired pose of a row. A row without a quaternion keeps the nominal orientation at its seed.
Transformd target_pose(const Targets& targets, int row, const Chain& nominal,
                       std::span<const double> seed) {
  const auto p = targets.p_B.row(row);
  if (targets.quat_B.rows() > 0) {
    const auto q = targets.quat_B.row(row);
    return from_pose({{p(0), p(1), p(2)}, {q(0), q(1), q(2), q(3)}});
  }
  Transformd X_BD = nominal.forward(seed);
  X_BD.p = p.transpose();
  return X_BD;
}

}  // namespace

CorrectedRow corrected_row(const SinglePoses& poses, const Targets& targets, int row,
                           std::span<const double> seed, SeedKind kind,
                           const std::vector<std::string>& sensors, KnownInputs& inputs) {
  CorrectedRow out;
  out.X_BD = target_pose(targets, row, poses.corrector().nominal(), seed);
  const MeasuredContext context = context_at(targets.context, row, sensors);
  out.correction = poses.correct(out.X_BD, seed, kind, context.known);
  out.command = to_pose(out.correction.X_BC);
  const bool solved = !refused(out.correction.status);
  const auto q = solved ? std::span<const double>(out.correction.q).first(seed.size()) : seed;
  out.correction.status = inputs.mark(q, context, true, out.correction.status);
  if (!solved) return out;
  out.limited = out.correction.status == Status::kLimited;
  const Matrix3 turn = out.correction.X_BC.R * out.X_BD.R.transpose();
  out.moved_m = (out.correction.X_BC.p - out.X_BD.p).norm();
  out.moved_rad = rotation_vector(turn).norm();
  out.faded = out.correction.status == Status::kOutsideDomain && out.moved_m < kNothing_m &&
              out.moved_rad < kNothing_rad;
  return out;
}

}  // namespace plumb::offline::cli
