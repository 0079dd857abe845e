// SPDX-License-Identifier: Apache-2.0
#include "compare/joint_shares.hpp"

#include <algorithm>
#include <cmath>

#include "compare/constants.hpp"
#include "numbers/tails.hpp"

namespace plumb::offline::compare {
namespace {

JointShare share_of(const StepMotions& motions, int joint, const Eigen::VectorXd& angle) {
  JointShare out;
  out.joint = joint;
  const auto n = static_cast<int>(angle.size());
  const double low = angle.minCoeff(), span = angle.maxCoeff() - low;
  out.bins = std::clamp(n / kPosesPerJointBin, 1, kMostJointBins);
  Eigen::VectorXd along = Eigen::VectorXd::Zero(out.bins), square = along, count = along;
  for (int i = 0; i < n; ++i) {
    const int k = std::clamp(static_cast<int>((angle(i) - low) / span * out.bins), 0, out.bins - 1);
    const Eigen::Vector3d t = motions.joint(i, joint);
    along(k) += t.dot(motions.error(i));
    square(k) += t.squaredNorm();
    count(k) += 1.0;
  }
  double explained = 0.0, turns = 0.0;
  for (int k = 0; k < out.bins; ++k) {
    if (!(square(k) > 0.0)) continue;
    explained += along(k) * along(k) / square(k);
    turns += count(k) * std::pow(along(k) / square(k), 2);
  }
  const double whole = motions.squares(), coordinates = static_cast<double>(motions.axes()) * n;
  const double left = whole - explained, free = coordinates - out.bins;
  if (!(left > 0.0) || free < 1.0) return out;
  out.ln_p = f_test(explained, out.bins, left, free).ln_p;
  out.share = std::max(0.0, 1.0 - left / free / (whole / coordinates));
  out.rms_rad = std::sqrt(turns / n);
  return out;
}

}  // namespace

std::vector<JointShare> joint_shares(const StepMotions& motions, const RowsN& q) {
  std::vector<JointShare> out;
  const RowsN used = q(motions.rows(), Eigen::all);
  for (int j = 0; j < motions.joints(); ++j) {
    const Eigen::VectorXd angle = used.col(j);
    if (!motions.turns(j) || !(angle.maxCoeff() - angle.minCoeff() > kJointMoves_rad)) continue;
    out.push_back(share_of(motions, j, angle));
  }
  for (auto& s : out)
    s.matters = s.ln_p < std::log(kPatternChance / static_cast<double>(out.size()));
  return out;
}

}  // namespace plumb::offline::compare
