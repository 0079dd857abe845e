// SPDX-License-Identifier: Apache-2.0
#include "tests/blind/orientation_case.hpp"

#include <array>

namespace plumb::tests {
namespace {

using offline::BlindArm;
using offline::BlindRequest;
using offline::MeasuredTurns;
using offline::StatedMasses;

constexpr std::array kTurnedPoses = {45, 150, 500};
constexpr std::array kTurnedNoise_um = {10, 20, 50};
constexpr std::array kTurnedNoise_urad = {10, 20, 50};
constexpr std::array kTurnedSigmas = {2.0, 5.0};
constexpr double kScatterMore = 20.0, kByPlace = 15.0;  // times the stated sigma
constexpr int kHidesNothing = 4;                        // one arm in so many
constexpr std::uint64_t kTurnedStream = 32452843;       // other arms than those of other studies

MeasuredTurns turns_of(int kind, double sigma_rad) {
  switch (kind) {
    case 1:
      return {.sigma_rad = sigma_rad, .times = kScatterMore};
    case 2:
      return {.sigma_rad = sigma_rad, .by_place_rad = kByPlace * sigma_rad};
    default:
      return {.sigma_rad = sigma_rad};
  }
}

}  // namespace

const std::vector<std::string>& orientation_kinds() {
  static const std::vector<std::string> names = {"as stated", "scatter by more", "wrong by place",
                                                 "points alone"};
  return names;
}

HiddenCase draw_orientation_case(std::uint64_t study_seed, int number) {
  const int kinds = static_cast<int>(orientation_kinds().size());
  const int kind = number % kinds, arm = number / kinds;
  Random random(study_seed * 1000003U + static_cast<std::uint64_t>(arm) + kTurnedStream);
  const auto one_of = [&random](const auto& from) {
    return from[static_cast<std::size_t>(random.below(static_cast<int>(from.size())))];
  };
  HiddenCase out;
  out.kind = orientation_kinds()[static_cast<std::size_t>(kind)];
  auto& r = out.request;
  r.seed = random.bits() >> 20;
  r.arm = random.below(2) == 0 ? BlindArm::kHeavy : BlindArm::kLight;
  r.sigma_m = one_of(kTurnedNoise_um) * 1e-6;
  r.poses = one_of(kTurnedPoses);
  r.masses = StatedMasses::kRight;
  const double sigma_rad = one_of(kTurnedNoise_urad) * 1e-6;
  if (kind + 1 < kinds) r.turns = turns_of(kind, sigma_rad);
  if (arm % kHidesNothing == 0) return out;
  out.group = Group::kOne;
  const auto laws = laws_of(Group::kOne);
  const auto& law = *laws[static_cast<std::size_t>(random.below(static_cast<int>(laws.size())))];
  hide_at(law, joint_for(law, random), one_of(kTurnedSigmas), random, out);
  return out;
}

}  // namespace plumb::tests
