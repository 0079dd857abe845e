// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "cell/measurements.hpp"
#include "plumb/format/model.hpp"
#include "plumb/runtime/transform.hpp"

namespace plumb::offline {

/// Tool poses of an arm for every choice of joint directions, and of zeros turned by quarter turns
/// at up to `most_turned` joints between the first and the last one (frame and reflector hide
/// turns of those two). The choices form a tree, and what they share is computed once: about two
/// transform products a row and choice.
class ArmSweep {
 public:
  /// q: shape (n, joints) [rad] or [m].
  ArmSweep(const format::Chain& chain, const RowsN& q, int most_turned);

  using Visit = std::function<void(const std::vector<bool>& reversed, const std::vector<int>& turns,
                                   const std::vector<Transformd>& X_BT)>;
  void run(const Visit& visit);

  /// The poses of one choice without turned zeros.
  std::vector<Transformd> poses(const std::vector<bool>& reversed) const;

 private:
  /// One joint counted one way, at every row: the motion and the link behind it.
  struct Option {
    bool reversed = false;
    int turns = 0;
    std::vector<Transformd> links;
  };
  void descend(int joint, int turned, const Visit& visit);

  int most_turned_;
  std::vector<std::vector<Option>> options_;     // by joint
  std::vector<std::vector<Transformd>> before_;  // up to each joint
  std::vector<bool> reversed_;
  std::vector<int> turns_;
};

}  // namespace plumb::offline
