// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

namespace plumb::offline::sim {

/// How the drives move the joints. Usually each drive moves one joint, and q_j = drive_j. The drive
/// of a coupled joint j stands beside that of joint j - 1 and turns its link through a
/// parallelogram with respect to the link that both drives stand on, as in palletisers:
///   q_j = drive_j - drive_(j-1)
/// The same holds for small errors of the drives. The torques of the drives follow from those about
/// the joint axes by virtual work: the transpose of that relation.
class Drives {
 public:
  Drives() = default;
  /// Zero-based joints, each at least 1.
  explicit Drives(std::vector<int> coupled) : coupled_(std::move(coupled)) {}

  bool any_coupled() const { return !coupled_.empty(); }
  bool is_coupled(int joint) const;

  /// Positions of the drives for positions of the joints, and the reverse.
  Eigen::VectorXd of_joints(Eigen::VectorXd q) const;
  Eigen::VectorXd to_joints(const Eigen::VectorXd& drives) const;

 private:
  std::vector<int> coupled_;
};

}  // namespace plumb::offline::sim
