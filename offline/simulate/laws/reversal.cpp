// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "simulate/law_list.hpp"

namespace plumb::offline::sim {
namespace {

constexpr double kUsualReversal_rad = 100e-6;
constexpr double kFrictionShare = 0.3;
constexpr double kTravel_rad = std::numbers::pi / 180.0;  // until the other flank is loaded

/// Hysteresis with memory and friction that grows with load:
///   b <- b + (-size sgn(d) - b) (1 - exp(-travel / q_c)) at every move, dq = b (1 + 0.3 |x|)
/// x = torque / largest torque; after long moves b = -size sgn(d).
class Reversal : public Law {
 public:
  Reversal(std::vector<SizedJoint> joints, const World& world)
      : joints_(std::move(joints)),
        torque_(largest_torque(world)),
        friction_share_(kFrictionShare * world.richness) {
    unloaded_.assign(world.visits.size(), VectorXd::Zero(world.arm.joints()));
    for (const auto& at : joints_) wind(at, world);
  }

  void bend(const Moment& now, Deflection& out) const override {
    for (const auto& at : joints_) {
      const int j = at.joint;
      const double x = torque_(j) > 0.0 ? now.loads.torque(j) / torque_(j) : 0.0;
      out.dq(j) +=
          unloaded_[static_cast<std::size_t>(now.row)](j) * (1.0 + friction_share_ * std::abs(x));
    }
  }

  nlohmann::ordered_json truth() const override {
    auto out = nlohmann::ordered_json::array();
    for (const auto& at : joints_) {
      out.push_back({{"joint", at.name},
                     {"half_gap_urad", at.size * 1e6},
                     {"travel_deg", kTravel_rad * 180.0 / std::numbers::pi},
                     {"more_under_load_by", torque_(at.joint) > 0.0 ? friction_share_ : 0.0}});
    }
    return out;
  }

 private:
  void wind(const SizedJoint& at, const World& world) {
    double b = 0.0, last_q = 0.5 * (world.q_min(at.joint) + world.q_max(at.joint));
    for (std::size_t row = 0; row < world.visits.size(); ++row) {
      const auto& visit = world.visits[row];
      const double flank = -at.size * visit.direction(at.joint);
      const double step = std::abs(visit.q(at.joint) - last_q);
      b -= (flank - b) * std::expm1(-step / kTravel_rad);
      last_q = visit.q(at.joint);
      unloaded_[row](at.joint) = b;
    }
  }

  std::vector<SizedJoint> joints_;
  VectorXd torque_;
  double friction_share_;
  std::vector<VectorXd> unloaded_;
};

std::vector<SizedJoint> backlash_joints(const HiddenEffect& effect, const World& world) {
  std::vector<bool> turns;
  for (int j = 0; j < world.arm.joints(); ++j) turns.push_back(!world.arm.slides(j));
  return sized_joints(effect, world, turns, turns, kUsualReversal_rad, "it slides");
}

}  // namespace

std::unique_ptr<Law> make_reversal(const HiddenEffect& effect, const World& world) {
  return std::make_unique<Reversal>(backlash_joints(effect, world), world);
}

// A controller that takes out more backlash than there is: the joints go too far, by the side they
// come from. The law is that of the reversal with a negative gap.
std::unique_ptr<Law> make_overcompensated_reversal(const HiddenEffect& effect, const World& world) {
  auto joints = backlash_joints(effect, world);
  for (auto& at : joints) at.size = -at.size;
  return std::make_unique<Reversal>(std::move(joints), world);
}

}  // namespace plumb::offline::sim
