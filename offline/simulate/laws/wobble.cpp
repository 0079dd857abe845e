// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <numbers>

#include "simulate/law_list.hpp"

namespace plumb::offline::sim {
namespace {

constexpr double kRunout_m = 0.2;           // radial runout over tilt
constexpr double kUsualWobble_rad = 40e-6;  // tilt
constexpr int kUsualJoint = 1;

/// Tilt and runout across the axis before the joint turns, once and twice a turn, each direction
/// with an amplitude and a phase of its own (the part that turns with the joint is geometry).
struct Wobble {
  SizedJoint at;
  // [h][k]: k = tilt x, tilt y, radial x, radial y, axial
  std::array<std::array<double, 5>, 2> share{}, phase{};

  double part(std::size_t k, double q) const {
    double sum = 0.0;
    for (std::size_t h = 0; h < share.size(); ++h) {
      sum += share[h][k] * std::cos(static_cast<double>(h + 1) * q + phase[h][k]);
    }
    return at.size * sum;
  }
};

Wobble draw(const SizedJoint& at, Random random) {
  Wobble out{at, {}, {}};
  for (auto& each : out.share) {
    for (double& s : each) s = random.uniform(0.4, 1.0);
  }
  for (auto& each : out.phase) {
    for (double& p : each) p = random.uniform(-std::numbers::pi, std::numbers::pi);
  }
  return out;
}

class AxisWobble : public Law {
 public:
  AxisWobble(std::vector<Wobble> joints, const World& world)
      : joints_(std::move(joints)), world_(world) {}

  void bend(const Moment& now, Deflection& out) const override {
    for (const auto& each : joints_) {
      const int j = each.at.joint;
      const double q = now.visit.q(j);
      const Vector3d e(each.part(0, q), each.part(1, q), 0.0);
      const Vector3d d =
          kRunout_m * Vector3d(each.part(2, q), each.part(3, q), 0.3 * each.part(4, q));
      // Before the joint motion means turned back by it, seen from behind.
      const double turn = world_.arm.chain().joints[static_cast<std::size_t>(j)].theta + q;
      const Eigen::AngleAxisd back(-turn, Vector3d::UnitZ());
      const auto i = static_cast<std::size_t>(j);
      out.link[i] = exp(back * d, back * e) * out.link[i];
    }
  }

  nlohmann::ordered_json truth() const override {
    auto out = nlohmann::ordered_json::array();
    for (const auto& each : joints_) {
      out.push_back({{"joint", each.at.name},
                     {"tilt_urad", each.at.size * 1e6},
                     {"runout_um", each.at.size * kRunout_m * 1e6},
                     {"shares", each.share},
                     {"phases_rad", each.phase}});
    }
    return out;
  }

 private:
  std::vector<Wobble> joints_;
  const World& world_;
};

}  // namespace

MadeLaw make_axis_wobble(const HiddenEffect& effect, const World& world) {
  std::vector<bool> turns, usual(static_cast<std::size_t>(world.arm.joints()), false);
  for (int j = 0; j < world.arm.joints(); ++j) turns.push_back(!world.arm.slides(j));
  if (kUsualJoint < world.arm.joints()) usual[kUsualJoint] = true;
  std::vector<Wobble> joints;
  for (const auto& at : sized_joints(effect, world, turns, usual, kUsualWobble_rad, "it slides")) {
    joints.push_back(draw(at, {world.seed, "wobble " + std::to_string(at.joint)}));
  }
  return std::make_unique<AxisWobble>(std::move(joints), world);
}

}  // namespace plumb::offline::sim
