// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "simulate/beam.hpp"
#include "simulate/law_list.hpp"

namespace plumb::offline::sim {
namespace {

constexpr double kUsualLinkTip_m = 0.15e-3;  // of one link's rotation, arm stretched
constexpr double kUsualLength = 0.15;        // of the reach: shorter links hardly bend

struct Link {
  SizedJoint at;  // size: largest rotation of its end at the reference poses [rad]
  TaperedBeam beam;
};

/// Bending of the link behind joint i at one pose, base frame.
BeamEnd bend_link(const World& world, int i, const TaperedBeam& beam, const VectorXd& q,
                  const Frames& frames, const Loads& loads) {
  const Vector3d link = frames.joint[i].linear() * world.arm.link_vector(i, q);
  const Vector3d end = frames.joint[i].translation() + link;
  return bend(beam, link.normalized(), loads.force(i + 1), loads.moment(i + 1, end),
              world.masses.gravity);
}

class LinkFlexure : public Law {
 public:
  LinkFlexure(std::vector<Link> links, const World& world)
      : links_(std::move(links)), world_(world) {}

  void bend(const Moment& now, Deflection& out) const override {
    for (const auto& link : links_) {
      const int i = link.at.joint;
      const VectorXd& q = now.visit.q;
      const BeamEnd end = bend_link(world_, i, link.beam, q, now.frames, now.loads);
      // The end turns about itself: move it to the origin of P_i and back.
      const Eigen::Matrix3d to_link = now.frames.joint[i].linear().transpose();
      const Eigen::Translation3d lever(world_.arm.link_vector(i, q));
      const Eigen::Translation3d shift(Vector3d(to_link * end.displacement));
      out.link[i] = shift * lever * exp(Vector3d::Zero(), to_link * end.rotation) *
                    lever.inverse() * out.link[i];
    }
  }

  nlohmann::ordered_json truth() const override {
    auto out = nlohmann::ordered_json::array();
    for (const auto& link : links_) {
      out.push_back({{"joint", link.at.name},
                     {"largest_urad", link.at.size * 1e6},
                     {"length_mm", link.beam.length * 1e3},
                     {"root_EI_Nm2", link.beam.EI},
                     {"GJ_over_EI", link.beam.GJ_over_EI},
                     {"taper", link.beam.taper},
                     {"mass_kg", link.beam.mass}});
    }
    return out;
  }

 private:
  std::vector<Link> links_;
  const World& world_;
};

double largest_rotation(const World& world, int i, const TaperedBeam& beam) {
  double largest = 0.0;
  for (const auto& q : reference_poses(world)) {
    const Frames frames = world.arm.frames(q);
    const Loads loads(world.masses, frames);
    largest = std::max(largest, bend_link(world, i, beam, q, frames, loads).rotation.norm());
  }
  return largest;
}

}  // namespace

std::unique_ptr<Law> make_link_flexure(const HiddenEffect& effect, const World& world) {
  const int n = world.arm.joints();
  const VectorXd middle = 0.5 * (world.q_min + world.q_max);
  const double reach = world.arm.reach();
  std::vector<TaperedBeam> beams(n);
  std::vector<bool> possible, usual;
  for (int i = 0; i < n; ++i) {
    beams[i].length = world.arm.link_vector(i, middle).norm();
    beams[i].mass = world.masses.mass[i];
    Random random(world.seed, "taper " + std::to_string(i));
    beams[i].taper = world.richness * random.uniform(0.1, 0.3);
    possible.push_back(beams[i].length > 0.01 * reach);
    usual.push_back(beams[i].length > kUsualLength * reach);
  }
  std::vector<Link> links;
  for (const auto& at : sized_joints(effect, world, possible, usual, kUsualLinkTip_m / reach,
                                     "the link behind it is too short")) {
    TaperedBeam& beam = beams[at.joint];
    beam.EI = largest_rotation(world, at.joint, beam) / at.size;
    links.push_back({at, beam});
  }
  return std::make_unique<LinkFlexure>(std::move(links), world);
}

}  // namespace plumb::offline::sim
