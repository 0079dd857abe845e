// SPDX-License-Identifier: Apache-2.0
#include "simulate/drives.hpp"

#include <algorithm>

namespace plumb::offline::sim {

bool Drives::is_coupled(int joint) const {
  return std::find(coupled_.begin(), coupled_.end(), joint) != coupled_.end();
}

Eigen::VectorXd Drives::of_joints(Eigen::VectorXd q) const {
  for (Eigen::Index j = 1; j < q.size(); ++j) {
    if (is_coupled(static_cast<int>(j))) q(j) += q(j - 1);
  }
  return q;
}

Eigen::VectorXd Drives::to_joints(const Eigen::VectorXd& drives) const {
  Eigen::VectorXd q = drives;
  for (Eigen::Index j = 1; j < q.size(); ++j) {
    if (is_coupled(static_cast<int>(j))) q(j) -= drives(j - 1);
  }
  return q;
}

}  // namespace plumb::offline::sim
