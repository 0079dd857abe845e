// SPDX-License-Identifier: Apache-2.0
#include "tests/blind/formula_case.hpp"

#include <array>

namespace plumb::tests {
namespace {

using offline::BlindArm;

constexpr std::array kFormulaLaws = {"joint_product", "directed_sine", "folded_sine", "growing",
                                     "other_joint",   "joint_memory",  "warm_encoder"};
constexpr std::array kFormulaPoses = {80, 150, 500};
constexpr std::array kFormulaNoise_um = {10, 20, 30};
constexpr std::uint64_t kStream = 7919;  // other arms than those of the blind study

}  // namespace

HiddenCase draw_formula_case(std::uint64_t study_seed, int number) {
  Random random(study_seed * 1000003U + static_cast<std::uint64_t>(number) + kStream);
  HiddenCase out;
  out.formulas = true;
  auto& r = out.request;
  r.seed = random.bits() >> 20;
  r.arm = random.below(2) == 0 ? BlindArm::kHeavy : BlindArm::kLight;
  r.sigma_m = kFormulaNoise_um[static_cast<std::size_t>(random.below(3))] * 1e-6;
  r.poses = kFormulaPoses[static_cast<std::size_t>(random.below(3))];
  const int turn = number / 2;
  const double sigmas = random.below(2) == 0 ? 2.0 : 5.0;
  const auto hide = [&](const offline::sim::LawEntry& law) {
    hide_at(law, joint_for(law, random), sigmas, random, out);
  };
  if (number % 2 == 0) {
    out.group = Group::kUnknown;
    hide(*offline::sim::find_law(
        kFormulaLaws[static_cast<std::size_t>(turn) % kFormulaLaws.size()]));
  } else if (turn % 3 == 2) {
    out.group = Group::kOne;
    const auto laws = laws_of(Group::kOne);
    hide(*laws[static_cast<std::size_t>(turn / 3) % laws.size()]);
  }
  return out;
}

}  // namespace plumb::tests
