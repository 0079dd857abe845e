// SPDX-License-Identifier: Apache-2.0
#include "tests/blind/narrow_case.hpp"

#include <array>

namespace plumb::tests {
namespace {

using offline::BlindArm;
using offline::PoseField;

constexpr std::array kFields = {PoseField::kLine, PoseField::kCurve, PoseField::kSurface};
constexpr std::array kNarrowPoses = {45, 150, 500};
constexpr std::array kNarrowNoise_um = {10, 20, 30};
constexpr double kSigmas = 5.0;
constexpr std::uint64_t kStream = 104729;  // other arms than those of the other studies

}  // namespace

const std::vector<std::string>& narrow_kinds() {
  static const std::vector<std::string> names{"along a line", "along a curve", "over a surface"};
  return names;
}

HiddenCase draw_narrow_case(std::uint64_t study_seed, int number) {
  Random random(study_seed * 1000003U + static_cast<std::uint64_t>(number) + kStream);
  const auto at = static_cast<std::size_t>(number);
  HiddenCase out;
  out.kind = narrow_kinds()[at % kFields.size()];
  auto& r = out.request;
  r.field = kFields[at % kFields.size()];
  r.seed = random.bits() >> 20;
  r.arm = random.below(2) == 0 ? BlindArm::kHeavy : BlindArm::kLight;
  r.sigma_m = kNarrowNoise_um[static_cast<std::size_t>(random.below(3))] * 1e-6;
  r.poses = kNarrowPoses[static_cast<std::size_t>(random.below(3))];
  const std::size_t turn = at / kFields.size();
  if (turn % 3 == 0) return out;
  out.group = Group::kOne;
  const auto laws = laws_of(Group::kOne);
  const auto& law = *laws[(turn + static_cast<std::size_t>(random.below(20))) % laws.size()];
  hide_at(law, joint_for(law, random), kSigmas, random, out);
  return out;
}

}  // namespace plumb::tests
