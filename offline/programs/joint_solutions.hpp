// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "plumb/format/model.hpp"
#include "plumb/runtime/chain.hpp"
#include "programs/program.hpp"

namespace plumb::offline::programs {

/// Joint positions [rad] or [m], as the chain counts.
using Joints = std::vector<double>;

/// The largest difference of a joint.
double distance(const Joints& a, const Joints& b);

/// Which joint positions of the nominal arm a target means. The arm is that of a model, and must
/// outlive this object.
class JointSolutions {
 public:
  explicit JointSolutions(const format::Chain& arm);

  struct Answer {
    Joints q;         // empty: it is not known
    std::string why;  // then, in words
    std::string help;
  };

  /// The solution that the configuration leaves; of several the one that is near `last` (may be
  /// empty), where the arm was before, and clearly nearest to it.
  ///
  /// Solutions are searched for from many starting points by Newton's method, within the joint
  /// limits. Cost: some milliseconds; some 20 us where the configuration tells wrist and elbow and
  /// `last` has them, too. Deterministic.
  Answer find(const Transformd& X_BT, const Configuration& wanted, const Joints& last) const;

  /// Whether these joints agree with all that is stated.
  bool agrees(const Configuration& wanted, const Joints& q) const;

  /// Joints [deg] or [mm] as the controller counts, in the chain's own angles; empty if there is
  /// another number of them.
  Joints of_controller(std::span<const double> values) const;
  std::vector<double> to_controller(Joints q) const;

 private:
  struct Posture {
    bool front, elbow_front;
  };
  bool converge(const Transformd& X_BT, Joints& q) const;
  void unwind(Joints& q) const;
  std::optional<Joints> next_to(const Transformd& X_BT, const Configuration& wanted,
                                const Joints& last) const;
  std::vector<Joints> all(const Transformd& X_BT, const Joints& last) const;
  std::vector<Joints> turned(const Joints& q, const Joints& last) const;
  Posture posture(const Joints& q) const;
  bool turns(std::size_t i) const;

  const format::Chain* arm_;
  Chain chain_;
};

}  // namespace plumb::offline::programs
