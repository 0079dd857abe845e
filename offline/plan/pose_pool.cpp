// SPDX-License-Identifier: Apache-2.0
#include "plan/pose_pool.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cell/random.hpp"
#include "plumb/runtime/chain.hpp"

namespace plumb::offline {
namespace {

/// Random poses that are tried for each pose of the pool.
constexpr int kTries = 200;

bool inside(const Vector3& p, const std::vector<PoseRules::Box>& boxes) {
  return boxes.empty() || std::any_of(boxes.begin(), boxes.end(), [&](const auto& box) {
           for (int k = 0; k < 3; ++k)
             if (p(k) < box.low[static_cast<std::size_t>(k)] ||
                 p(k) > box.high[static_cast<std::size_t>(k)])
               return false;
           return true;
         });
}

/// Ends of the range of a joint that may be used.
std::pair<double, double> joint_range(const Cell& cell, const PoseRules& rules, int joint) {
  const auto& row = cell.nominal.joints[static_cast<std::size_t>(joint)];
  const double margin = 0.5 * (1.0 - rules.joint_share) * (row.q_max - row.q_min);
  return {row.q_min + margin, row.q_max - margin};
}

Vector3 reflector(const Chain& chain, const ArmState& state, const Eigen::VectorXd& q,
                  ChainFrames& frames) {
  chain.frames({q.data(), static_cast<std::size_t>(q.size())}, frames);
  return frames.tip * Vector3(state.X_TG.p[0], state.X_TG.p[1], state.X_TG.p[2]);
}

}  // namespace

Vector3 reflector_B(const ArmState& state, const Eigen::VectorXd& q) {
  ChainFrames frames;
  return reflector(Chain(state.arm.calibrated), state, q, frames);
}

Eigen::VectorXd pose_beside(const Cell& cell, const ArmState& state, const PoseRules& rules,
                            const Eigen::VectorXd& q, Random& random) {
  Eigen::VectorXd out = q;
  const int moved = random.unit() < 0.5 ? 1 : 2;
  for (int k = 0; k < moved; ++k) {
    const auto j = std::min(
        static_cast<Eigen::Index>(random.unit() * static_cast<double>(q.size())), q.size() - 1);
    const auto [low, high] = joint_range(cell, rules, static_cast<int>(j));
    const double where = random.unit();
    out(j) = where < 0.25 ? low : where < 0.5 ? high : low + random.unit() * (high - low);
  }
  return inside(reflector_B(state, out), rules.boxes) ? out : q;
}

RowsN pose_pool(const Cell& cell, const ArmState& state, const PoseRules& rules) {
  const Chain chain(state.arm.calibrated);
  ChainFrames frames;
  Random random(rules.seed);
  RowsN out(rules.pool, cell.joints());
  Eigen::VectorXd q(cell.joints());
  int found = 0;
  for (long tries = 0; tries < static_cast<long>(kTries) * rules.pool && found < rules.pool;
       ++tries) {
    for (int j = 0; j < cell.joints(); ++j) {
      const auto [low, high] = joint_range(cell, rules, j);
      q(j) = low + random.unit() * (high - low);
    }
    if (inside(reflector(chain, state, q, frames), rules.boxes)) out.row(found++) = q.transpose();
  }
  if (found == 0)
    throw Failure(Exit::kNumbersSayNo,
                  {.code = "E-PLAN-BOX",
                   .message = fmt::format("none of {} random poses reaches the box",
                                          static_cast<long>(kTries) * rules.pool),
                   .help = "coordinates are of the reflector in the base frame: --box "
                           "-1000,1000,-1000,1000,0,1500"});
  out.conservativeResize(found, Eigen::NoChange);
  return out;
}

}  // namespace plumb::offline
