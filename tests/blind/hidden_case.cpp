// SPDX-License-Identifier: Apache-2.0
#include "tests/blind/hidden_case.hpp"

#include <fmt/format.h>

#include <array>
#include <set>

namespace plumb::tests {
namespace {

using offline::BlindArm;
using offline::sim::LawEntry;

constexpr std::array kPoses = {45, 150, 500, 1500};
constexpr std::array kSigmas_um = {10, 20, 30};

/// Not a case of this part of the study: planar beams have their own test, and what came later is
/// drawn by the studies of inconvenient arms, of formulas and of imitators, so that the cases of a
/// seed remain the same.
bool is_drawn(const LawEntry& law) {
  const std::set<std::string> of_other_parts = {
      "folded_sine", "growing",      "directed_sine",   "encoder_counts",     "axial_play",
      "moving_air",  "rocking_base", "unsensed_growth", "parallelogram_wave", "sunny_link"};
  return !of_other_parts.contains(law.name) && law.name.rfind("planar", 0) != 0 &&
         law.name.rfind("two_steps", 0) != 0 && law.name != "overcompensated_reversal";
}
bool is_step(const LawEntry& law) { return law.library == "step"; }

HiddenCase::Answer answer_of(const LawEntry& law, int joint, double sigmas) {
  HiddenCase::Answer out;
  out.law = law.name;
  out.names = {law.library};
  out.joint = joint;
  out.sigmas = sigmas;
  out.names.insert(out.names.end(), law.same_as.begin(), law.same_as.end());
  return out;
}

std::string spec_of(const LawEntry& law, int joint, double sigmas, Random& random) {
  std::string out = law.name + ":";
  if (joint >= 0) out += fmt::format("J{}", joint + 1);
  out += fmt::format(":{:g}", sigmas);
  if (law.name == "gear_ripple") out += fmt::format("@cycles={}", 5 + random.below(30));
  return out;
}

Group group_of(int number) {
  // 1 in 8 nothing, 3 in 8 one effect, and one share for each of the rest.
  constexpr std::array kTurn = {Group::kOne,  Group::kNothing, Group::kOne,  Group::kUnknown,
                                Group::kWeak, Group::kOne,     Group::kStep, Group::kThree};
  return kTurn[static_cast<std::size_t>(number) % kTurn.size()];
}

}  // namespace

std::vector<const LawEntry*> laws_of(Group group) {
  std::vector<const LawEntry*> out;
  for (const auto& law : offline::sim::law_entries()) {
    if (!is_drawn(law)) continue;
    const bool unknown = law.library == "unknown";
    const bool fits = group == Group::kUnknown ? unknown
                      : group == Group::kStep  ? is_step(law)
                      : group == Group::kThree ? !unknown
                                               : !unknown && !is_step(law);
    if (fits) out.push_back(&law);
  }
  return out;
}

int joint_for(const LawEntry& law, Random& random) {
  if (law.on == LawEntry::On::kArm) return -1;
  if (law.name == "gravity_compensator") return 1;
  if (law.name == "dress_pack" || law.name == "joint_product") return 3 + random.below(3);
  const bool by_weight = law.name.find("compliance") != std::string::npos ||
                         law.name == "link_flexure" || law.name == "backlash_load";
  return by_weight ? 1 + random.below(law.name == "link_flexure" ? 2 : 3) : random.below(6);
}

void hide_at(const LawEntry& law, int joint, double sigmas, Random& random, HiddenCase& out) {
  out.request.effects.push_back(spec_of(law, joint, sigmas, random));
  out.hidden.push_back(answer_of(law, joint, sigmas));
}

const char* name_of(Group group) {
  switch (group) {
    case Group::kNothing:
      return "nothing";
    case Group::kOne:
      return "one";
    case Group::kWeak:
      return "weak";
    case Group::kUnknown:
      return "unknown";
    case Group::kStep:
      return "step";
    default:
      return "three";
  }
}

namespace {

void hide(const LawEntry& law, double sigmas, Random& random, HiddenCase& out) {
  hide_at(law, joint_for(law, random), sigmas, random, out);
}

}  // namespace

HiddenCase draw_case(std::uint64_t study_seed, int number) {
  Random random(study_seed * 1000003U + static_cast<std::uint64_t>(number));
  HiddenCase out;
  out.group = group_of(number);
  const int turn = number / 8;
  auto& r = out.request;
  r.seed = random.bits() >> 20;
  r.arm = random.below(2) == 0 ? BlindArm::kHeavy : BlindArm::kLight;
  r.sigma_m = kSigmas_um[static_cast<std::size_t>(random.below(3))] * 1e-6;
  const bool many = out.group == Group::kWeak || out.group == Group::kThree;
  r.poses = kPoses[static_cast<std::size_t>(many ? 1 + random.below(3) : random.below(4))];
  const auto laws = laws_of(out.group);
  const auto draw = [&] {
    return laws[static_cast<std::size_t>(random.below(static_cast<int>(laws.size())))];
  };
  // Laws in turn, so that a slice sees them all.
  const auto* law = laws.empty()
                        ? nullptr
                        : laws[static_cast<std::size_t>(turn * 3 + (number % 8) / 2) % laws.size()];
  constexpr std::array kSizes = {1.0, 2.0, 5.0};
  switch (out.group) {
    case Group::kNothing:
      break;
    case Group::kOne:
      hide(*law, kSizes[static_cast<std::size_t>(random.below(3))], random, out);
      break;
    case Group::kWeak:
      hide(*law, 0.5, random, out);
      break;
    case Group::kUnknown:
      hide(*law, kSizes[static_cast<std::size_t>(1 + random.below(2))], random, out);
      break;
    case Group::kStep:
      hide(*law, 5.0, random, out);
      break;
    case Group::kThree: {
      std::set<std::string> used;
      for (double sigmas : {5.0, 2.0, 1.0}) {
        const LawEntry* one = draw();
        while (!used.insert(one->library).second) one = draw();
        hide(*one, sigmas, random, out);
      }
    }
  }
  return out;
}

}  // namespace plumb::tests
