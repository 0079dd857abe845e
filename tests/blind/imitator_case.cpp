// SPDX-License-Identifier: Apache-2.0
#include "tests/blind/imitator_case.hpp"

#include <array>

namespace plumb::tests {
namespace {

using offline::BlindArm;
using offline::BlindRequest;
using offline::StatedMasses;

constexpr std::array kImitatorPoses = {45, 150, 500};
constexpr std::array kImitatorNoise_um = {10, 20, 30};
constexpr std::array kImitatorSigmas = {2.0, 5.0, 5.0};
constexpr std::uint64_t kImitatorStream = 15485863;  // other arms than those of the other studies

struct Imitator {
  std::string name;
  std::string law;
  int first_joint = -1, joints = 1;  // of those where it is usual; -1: a law of the whole arm
};

const std::array<Imitator, 7>& imitators() {
  static const std::array<Imitator, 7> all{{
      {"wrong counts at all joints", "encoder_counts"},
      {"axial play of J1", "axial_play"},
      {"moving air", "moving_air"},
      {"rocking base", "rocking_base"},
      {"growth without a sensor", "unsensed_growth"},
      {"wave of a parallelogram", "parallelogram_wave", 2, 1},
      {"sun on a link", "sunny_link", 1, 2},
  }};
  return all;
}

}  // namespace

const std::vector<std::string>& imitator_kinds() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> out;
    for (const auto& one : imitators()) out.push_back(one.name);
    return out;
  }();
  return names;
}

HiddenCase draw_imitator_case(std::uint64_t study_seed, int number) {
  Random random(study_seed * 1000003U + static_cast<std::uint64_t>(number) + kImitatorStream);
  const Imitator& kind = imitators()[static_cast<std::size_t>(number) % imitators().size()];
  const auto one_of = [&random](const auto& from) {
    return from[static_cast<std::size_t>(random.below(static_cast<int>(from.size())))];
  };
  HiddenCase out;
  out.kind = kind.name;
  auto& r = out.request;
  r.seed = random.bits() >> 20;
  r.arm = random.below(2) == 0 ? BlindArm::kHeavy : BlindArm::kLight;
  r.sigma_m = one_of(kImitatorNoise_um) * 1e-6;
  r.poses = one_of(kImitatorPoses);
  r.masses = StatedMasses::kRight;
  if (random.below(2) == 0) r.payloads = BlindRequest::Payloads::kConstant;
  if (random.below(2) == 0) r.revisits = r.poses / 10;
  if (kind.law == "unsensed_growth") r.temperatures = offline::Recorded::kNever;
  const auto& law = *offline::sim::find_law(kind.law);
  out.group = law.library == "unknown" ? Group::kUnknown : Group::kOne;
  const int joint = kind.first_joint < 0 ? -1 : kind.first_joint + random.below(kind.joints);
  hide_at(law, joint, one_of(kImitatorSigmas), random, out);
  return out;
}

}  // namespace plumb::tests
