// SPDX-License-Identifier: Apache-2.0
#include "diagnose/regressor.hpp"

namespace plumb::offline {
namespace {

Eigen::MatrixXd series_motions(const WhitenedFit& s, const Regressor& series) {
  const Eigen::Index each = series.columns.cols() / static_cast<Eigen::Index>(series.joints.size());
  Eigen::MatrixXd out(s.table.lines(), series.columns.cols());
  for (Eigen::Index c = 0; c < out.cols(); ++c) {
    const Eigen::VectorXd& joint = s.joint[series.joints[static_cast<std::size_t>(c / each)]];
    for (Eigen::Index i = 0; i < out.rows(); ++i)
      out(i, c) = series.columns(s.table.reading(i), c) * joint(i);
  }
  return out;
}

}  // namespace

Eigen::MatrixXd motions(const WhitenedFit& s, const Regressor& regressor) {
  if (!regressor.joints.empty()) return series_motions(s, regressor);
  if (regressor.joint < 0) return regressor.columns;
  Eigen::MatrixXd out(s.table.lines(), regressor.columns.cols());
  for (Eigen::Index i = 0; i < out.rows(); ++i)
    out.row(i) = regressor.columns.row(s.table.reading(i)) * s.joint[regressor.joint](i);
  return out;
}

Eigen::VectorXd motion(const WhitenedFit& s, const Regressor& regressor,
                       const Eigen::VectorXd& theta) {
  if (regressor.joints.empty() && regressor.joint < 0) return regressor.columns * theta;
  const std::vector<int> joints =
      regressor.joints.empty() ? std::vector<int>{regressor.joint} : regressor.joints;
  const Eigen::Index each = theta.size() / static_cast<Eigen::Index>(joints.size());
  Eigen::VectorXd out = Eigen::VectorXd::Zero(s.table.lines());
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const auto first = static_cast<Eigen::Index>(j) * each;
    const Eigen::VectorXd turn =
        regressor.columns.middleCols(first, each) * theta.segment(first, each);
    for (Eigen::Index i = 0; i < out.size(); ++i)
      out(i) += turn(s.table.reading(i)) * s.joint[joints[j]](i);
  }
  return out;
}

}  // namespace plumb::offline
