// SPDX-License-Identifier: Apache-2.0
#include "check/arm_sweep.hpp"

#include <cmath>

#include "plumb/runtime/chain.hpp"

namespace plumb::offline {
namespace {

Transformd link_behind(const format::JointRow& row, double q, int turns, const Transformd& C) {
  const double position = row.scale * q + row.offset;
  if (row.type == format::JointType::kRevolute)
    return rot_z(position + row.theta + M_PI_2 * turns) * C;
  return translation(0.0, 0.0, position + row.d) * C;
}

}  // namespace

ArmSweep::ArmSweep(const format::Chain& chain, const RowsN& q, int most_turned)
    : most_turned_(most_turned) {
  const Chain folded(chain);
  const auto n = static_cast<int>(chain.joints.size());
  options_.resize(n);
  before_.assign(n + 1, std::vector<Transformd>(q.rows()));
  reversed_.assign(n, false);
  turns_.assign(n, 0);
  for (auto& X : before_[0]) X = folded.constant(0);
  for (int j = 0; j < n; ++j) {
    const auto& row = chain.joints[j];
    const bool can_turn = most_turned > 0 && j > 0 && j + 1 < n && folded.revolute(j);
    for (const bool reversed : {false, true})
      for (int turns = can_turn ? -1 : 0; turns <= (can_turn ? 2 : 0); ++turns) {
        Option option{reversed, turns, {}};
        for (Eigen::Index i = 0; i < q.rows(); ++i)
          option.links.push_back(
              link_behind(row, reversed ? -q(i, j) : q(i, j), turns, folded.constant(j + 1)));
        options_[j].push_back(std::move(option));
      }
  }
}

void ArmSweep::run(const Visit& visit) { descend(0, 0, visit); }

std::vector<Transformd> ArmSweep::poses(const std::vector<bool>& reversed) const {
  std::vector<Transformd> out = before_[0];
  for (std::size_t joint = 0; joint < options_.size(); ++joint)
    for (const Option& option : options_[joint])
      if (option.turns == 0 && option.reversed == reversed[joint])
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = out[i] * option.links[i];
  return out;
}

void ArmSweep::descend(int joint, int turned, const Visit& visit) {
  if (joint == static_cast<int>(options_.size())) return visit(reversed_, turns_, before_.back());
  for (const Option& option : options_[joint]) {
    if (option.turns != 0 && turned == most_turned_) continue;
    reversed_[joint] = option.reversed;
    turns_[joint] = option.turns;
    const auto& from = before_[joint];
    auto& to = before_[joint + 1];
    for (std::size_t i = 0; i < from.size(); ++i) to[i] = from[i] * option.links[i];
    descend(joint + 1, turned + (option.turns != 0 ? 1 : 0), visit);
  }
}

}  // namespace plumb::offline
