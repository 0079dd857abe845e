// SPDX-License-Identifier: Apache-2.0
#include "compare/joint_shares.hpp"

#include <algorithm>
#include <cmath>

#include "compare/constants.hpp"
#include "numbers/tails.hpp"

namespace plumb::offline::compare {
namespace {

/// What one value for each bin of the angle explains.
///
/// along, square  For each pose the product of the error with the motion per unit of the joint, and
///                the squared motion.
/// whole          The sum of the squared errors, over so many coordinates.
JointShare share_of(int joint, const Eigen::VectorXd& angle, const Eigen::VectorXd& along,
                    const Eigen::VectorXd& square, double whole, double coordinates) {
  JointShare out;
  out.joint = joint;
  const auto n = static_cast<int>(angle.size());
  const double low = angle.minCoeff(), span = angle.maxCoeff() - low;
  out.bins = std::clamp(n / kPosesPerJointBin, 1, kMostJointBins);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(out.bins), weight = sum, count = sum;
  for (int i = 0; i < n; ++i) {
    const int k = std::clamp(static_cast<int>((angle(i) - low) / span * out.bins), 0, out.bins - 1);
    sum(k) += along(i);
    weight(k) += square(i);
    count(k) += 1.0;
  }
  double explained = 0.0, turns = 0.0;
  for (int k = 0; k < out.bins; ++k) {
    if (!(weight(k) > 0.0)) continue;
    explained += sum(k) * sum(k) / weight(k);
    turns += count(k) * std::pow(sum(k) / weight(k), 2);
  }
  const double left = whole - explained, free = coordinates - out.bins;
  if (!(left > 0.0) || free < 1.0) return out;
  out.ln_p = f_test(explained, out.bins, left, free).ln_p;
  out.share = std::max(0.0, 1.0 - left / free / (whole / coordinates));
  out.rms_rad = std::sqrt(turns / n);
  return out;
}

bool moves(const Eigen::VectorXd& angle) {
  return angle.size() > 0 && angle.maxCoeff() - angle.minCoeff() > kJointMoves_rad;
}

void set_matters(std::vector<JointShare>& shares) {
  for (auto& s : shares)
    s.matters = s.ln_p < std::log(kPatternChance / static_cast<double>(shares.size()));
}

}  // namespace

std::vector<JointShare> joint_shares(const StepMotions& motions, const RowsN& q) {
  std::vector<JointShare> out;
  const RowsN used = q(motions.rows(), Eigen::all);
  const auto n = static_cast<Eigen::Index>(motions.size());
  for (int j = 0; j < motions.joints(); ++j) {
    const Eigen::VectorXd angle = used.col(j);
    if (!motions.turns(j) || !moves(angle)) continue;
    Eigen::VectorXd along(n), square(n);
    for (int i = 0; i < motions.size(); ++i) {
      const Eigen::Vector3d t = motions.joint(i, j);
      along(i) = t.dot(motions.error(i));
      square(i) = t.squaredNorm();
    }
    out.push_back(share_of(j, angle, along, square, motions.squares(),
                           static_cast<double>(motions.axes() * n)));
  }
  set_matters(out);
  return out;
}

std::vector<JointShare> turn_shares(const RowsN& about, const Rows3& turned, const RowsN& q,
                                    const std::vector<int>& rows) {
  std::vector<JointShare> out;
  const auto n = static_cast<Eigen::Index>(rows.size());
  const double whole = turned(rows, Eigen::all).squaredNorm();
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(n);
  for (int j = 0; j < q.cols(); ++j) {
    const Eigen::VectorXd angle = q.col(j)(rows), along = about.col(j)(rows);
    if (!moves(angle) || along.isZero()) continue;
    out.push_back(share_of(j, angle, along, ones, whole, 3.0 * static_cast<double>(n)));
  }
  set_matters(out);
  return out;
}

std::optional<AxisShare> main_axis(const RowsN& about, const Rows3& turned,
                                   const std::vector<int>& rows) {
  const Eigen::VectorXd squares = turned(rows, Eigen::all).rowwise().squaredNorm();
  if (rows.empty() || !(squares.sum() > 0.0)) return std::nullopt;
  AxisShare out;
  for (int j = 0; j < about.cols(); ++j) {
    const double share = Eigen::VectorXd(about.col(j)(rows)).squaredNorm() / squares.sum();
    if (share > out.share) out = {j, share};
  }
  // The squared cosine between an axis and any direction has the mean 1/3 and the variance 4/45;
  // what is large counts more.
  const double sigma = std::sqrt(4.0 / 45.0) * squares.norm() / squares.sum();
  return out.share > 1.0 / 3.0 + kClearAxis * sigma ? std::optional(out) : std::nullopt;
}

}  // namespace plumb::offline::compare
