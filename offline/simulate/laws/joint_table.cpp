// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <numbers>

#include "simulate/joint_law.hpp"
#include "simulate/law_list.hpp"

namespace plumb::offline::sim {
namespace {

constexpr int kHarmonics = 12;

struct Table {
  std::array<double, kHarmonics> sine{}, cosine{};
  double dent = 0.0;        // place of a worn tooth [rad]
  double sharpness = 20.0;  // of the dent
  double at(double q) const {
    double sum = std::exp(sharpness * (std::cos(q - dent) - 1.0));
    for (int h = 1; h <= kHarmonics; ++h) {
      const auto k = static_cast<std::size_t>(h - 1);
      sum += sine[k] * std::sin(h * q) + cosine[k] * std::cos(h * q);
    }
    return sum;
  }
};

}  // namespace

// An irregular periodic error of a joint: twelve slowly decreasing harmonics and one worn tooth.
// The size is the height of the worn tooth.
MadeLaw make_joint_table(const HiddenEffect& effect, const World& world) {
  constexpr double kUsualTable_rad = 100e-6;
  constexpr int kUsualJoint = 1;
  std::vector<JointError> out;
  for (const auto& at : sized_joints(effect, world, turning(world), only(world, kUsualJoint),
                                     kUsualTable_rad, "it slides")) {
    Random random = joint_random(world, "joint table", at.joint);
    Table table;
    for (int h = 1; h <= kHarmonics; ++h) {
      const auto k = static_cast<std::size_t>(h - 1);
      table.sine[k] = 0.6 * random.normal() / std::sqrt(h);
      table.cosine[k] = 0.6 * random.normal() / std::sqrt(h);
    }
    table.dent = random.uniform(world.q_min(at.joint), world.q_max(at.joint));
    table.sharpness = random.uniform(15.0, 40.0);
    out.push_back({at,
                   [=](const Moment& now) { return at.size * table.at(now.visit.q(at.joint)); },
                   {{"sine", table.sine},
                    {"cosine", table.cosine},
                    {"dent_rad", table.dent},
                    {"dent_sharpness", table.sharpness}},
                   {angle_name(at.joint)}});
  }
  return joint_law(std::move(out));
}

}  // namespace plumb::offline::sim
