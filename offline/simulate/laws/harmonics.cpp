// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <numbers>

#include "simulate/law_list.hpp"

namespace plumb::offline::sim {
namespace {

using Shares = std::array<double, 3>;  // of the first, second and third harmonic
constexpr Shares kShare{1.0, 0.6, 0.08};
constexpr double kHarmonicsLoadShare = 0.15;  // growth of the amplitude at the largest torque
constexpr double kUsualSize_rad = 100e-6;

/// dq = size (1 + m torque / largest torque) sum_h share_h sin(h q + phase_h).
struct Gear {
  SizedJoint at;
  Shares phase{};
  double torque = 0.0;  // largest at the reference poses [N m]; 0: no load
  Shares share = kShare;
  double load_share = kHarmonicsLoadShare;
};

class GearHarmonics : public Law {
 public:
  explicit GearHarmonics(std::vector<Gear> gears) : gears_(std::move(gears)) {}

  void bend(const Moment& now, Deflection& out) const override {
    for (const auto& gear : gears_) {
      const double q = now.visit.q(gear.at.joint);
      double sum = 0.0;
      for (std::size_t h = 0; h < kShare.size(); ++h) {
        sum += gear.share[h] * std::sin(static_cast<double>(h + 1) * q + gear.phase[h]);
      }
      const double load = gear.torque > 0.0 ? now.loads.torque(gear.at.joint) / gear.torque : 0.0;
      out.dq(gear.at.joint) += gear.at.size * (1.0 + gear.load_share * load) * sum;
    }
  }

  nlohmann::ordered_json truth() const override {
    auto out = nlohmann::ordered_json::array();
    for (const auto& gear : gears_) {
      auto harmonics = nlohmann::ordered_json::array();
      for (std::size_t h = 0; h < kShare.size(); ++h) {
        harmonics.push_back({{"cycles_per_turn", h + 1},
                             {"amplitude_urad", gear.at.size * gear.share[h] * 1e6},
                             {"phase_rad", gear.phase[h]}});
      }
      out.push_back({{"joint", gear.at.name},
                     {"harmonics", harmonics},
                     {"load_share", gear.torque > 0.0 ? gear.load_share : 0.0},
                     {"largest_torque_Nm", gear.torque}});
    }
    return out;
  }

 private:
  std::vector<Gear> gears_;
};

}  // namespace

std::unique_ptr<Law> make_gear_harmonics(const HiddenEffect& effect, const World& world) {
  std::vector<bool> turns;
  for (int j = 0; j < world.arm.joints(); ++j) turns.push_back(!world.arm.slides(j));
  Random random(world.seed, "gear phases");
  std::vector<Shares> phase(turns.size());
  for (auto& joint : phase) {
    for (double& p : joint) p = random.uniform(-std::numbers::pi, std::numbers::pi);
  }
  const VectorXd torque = largest_torque(world);
  std::vector<Gear> gears;
  for (const auto& at : sized_joints(effect, world, turns, turns, kUsualSize_rad, "it slides")) {
    Gear gear{at, phase[at.joint], torque(at.joint)};
    gear.share[2] *= world.richness;
    gear.load_share *= world.richness;
    gears.push_back(gear);
  }
  return std::make_unique<GearHarmonics>(std::move(gears));
}

}  // namespace plumb::offline::sim
