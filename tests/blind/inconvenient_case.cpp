// SPDX-License-Identifier: Apache-2.0
#include "tests/blind/inconvenient_case.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace plumb::tests {
namespace {

using offline::BlindArm;
using offline::BlindRequest;
using offline::StatedMasses;
using offline::sim::LawEntry;

using Names = std::vector<std::string>;

constexpr std::array kPoseCounts = {30, 45, 80, 150, 500, 1500};
constexpr std::array kTrackerSigmas_um = {10, 20, 30};
constexpr std::array kEffectSigmas = {2.0, 5.0, 5.0};
constexpr double kMostScatter = 40e-6;
/// 0.001 deg and 0.01 deg, as controllers print angles, and two between.
constexpr std::array kEncoderSteps = {17.453e-6, 50e-6, 100e-6, 174.53e-6};
constexpr double kGravity = 9.81;

const Names kGravityLaws = {
    "joint_compliance", "joint_compliance_soft", "link_flexure",    "backlash_load",
    "cross_compliance", "payload_compliance",    "base_compliance", "tool_sag"};
const Names kWeightlessLaws = {"joint_compliance", "joint_compliance_soft", "link_flexure",
                               "base_compliance", "tool_sag"};
const Names kTurningLaws = {"gear_harmonics", "gear_ripple",    "joint_table",
                            "reversal",       "axis_wobble",    "encoder_eccentricity",
                            "thermal_growth", "step_reflector", "drift"};
const Names kPalletiserLaws = {"gear_harmonics",   "gear_ripple", "joint_table",
                               "joint_compliance", "reversal",    "thermal_growth",
                               "step_base",        "drift"};
const Names kAnywhereUnknown = {"joint_memory", "room_sway", "tool_wander", "warm_encoder"};

template <class Numbers>
auto one_of(const Numbers& numbers, Random& random) {
  return numbers[static_cast<std::size_t>(random.below(static_cast<int>(numbers.size())))];
}

void scatter(HiddenCase& out, Random& random) {
  auto& sigmas = out.request.imperfections.joint_scatter;
  const int joints = out.request.arm == BlindArm::kTrack ? 7 : 6;
  for (int j = 0; j < joints; ++j) sigmas.push_back(random.uniform(0.0, kMostScatter));
}

/// A wall, a ceiling, or a tilt of 5 to 30 deg that nobody told cell.toml.
std::array<double, 3> other_gravity(Random& random) {
  const double bearing = random.uniform(-std::numbers::pi, std::numbers::pi);
  const int how = random.below(3);
  const double from_down = how == 0   ? std::numbers::pi / 2.0
                           : how == 1 ? std::numbers::pi
                                      : random.uniform(5.0, 30.0) * std::numbers::pi / 180.0;
  const double across = kGravity * std::sin(from_down);
  return {across * std::cos(bearing), across * std::sin(bearing), -kGravity * std::cos(from_down)};
}

/// What makes an arm inconvenient, and which effects are then hidden in it.
struct Kind {
  std::string name;
  Names laws = {};     // none: all that a six-axis arm of the first part may have
  Names unknown = {};  // likewise
  std::string own;     // a law that belongs to the kind and is hidden in every case
  void (*make)(HiddenCase&, Random&) = nullptr;
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all{
      {.name = kConvenient, .own = {}},
      {.name = "joint scatter", .own = {}, .make = scatter},
      {.name = "rounded encoders",
       .own = {},
       .make =
           [](HiddenCase& out, Random& random) {
             out.request.imperfections.encoder_step = one_of(kEncoderSteps, random);
           }},
      {.name = "wrong gravity",
       .laws = kGravityLaws,
       .own = {},
       .make =
           [](HiddenCase& out, Random& random) {
             out.request.imperfections.gravity = other_gravity(random);
             out.related = {"gravity_direction", "gravity_free"};
           }},
      {.name = "unknown weights",
       .laws = kWeightlessLaws,
       .own = {},
       .make =
           [](HiddenCase& out, Random& random) {
             out.request.masses = StatedMasses::kNone;
             if (random.below(2) == 0) out.request.payloads = BlindRequest::Payloads::kConstant;
           }},
      {.name = "centres of mass in the other frame",
       .laws = kGravityLaws,
       .own = {},
       .make = [](HiddenCase& out, Random&) { out.request.masses = StatedMasses::kOtherFrame; }},
      {.name = "sliding axis",
       .laws = kTurningLaws,
       .unknown = kAnywhereUnknown,
       .own = {},
       .make =
           [](HiddenCase& out, Random& random) {
             out.request.arm = random.below(2) == 0 ? BlindArm::kTrack : BlindArm::kScara;
           }},
      {.name = "palletiser",
       .laws = kPalletiserLaws,
       .unknown = kAnywhereUnknown,
       .own = {},
       .make = [](HiddenCase& out, Random&) { out.request.arm = BlindArm::kPalletiser; }},
      {.name = "over-compensated reversal", .own = "overcompensated_reversal"},
      {.name = "set-up that moves twice", .own = "two_steps_base"},
      {.name = "several at once",
       .laws = {"joint_compliance", "gear_harmonics", "gear_ripple", "reversal", "drift",
                "thermal_growth"},
       .own = {},
       .make =
           [](HiddenCase& out, Random& random) {
             scatter(out, random);
             out.request.imperfections.encoder_step = one_of(kEncoderSteps, random);
             out.request.masses = StatedMasses::kNone;
             if (random.below(2) == 0) {
               out.request.imperfections.gravity = other_gravity(random);
               out.related = {"gravity_direction", "gravity_free"};
             }
           }},
  };
  return all;
}

/// A joint of this arm where the law is possible, or -1 for a law of the whole arm.
int joint_of(const LawEntry& law, BlindArm arm, Random& random) {
  if (law.on == LawEntry::On::kArm) return -1;
  switch (arm) {
    case BlindArm::kScara:
      return random.below(2);
    case BlindArm::kPalletiser:
      return law.name == "joint_compliance" ? 1 + random.below(2) : random.below(3);
    case BlindArm::kTrack:
      return 1 + joint_for(law, random);
    default:
      return joint_for(law, random);
  }
}

void hide_one(const LawEntry& law, double sigmas, Random& random, HiddenCase& out) {
  const BlindArm arm = out.request.arm;
  hide_at(law, joint_of(law, arm, random), sigmas, random, out);
  auto& answer = out.hidden.back();
  // The drive of a palletiser's second joint turns the third as well, and that of the third the
  // fourth.
  if (arm == BlindArm::kPalletiser && answer.joint >= 1) answer.also_joint = answer.joint + 1;
  if (out.request.masses == StatedMasses::kNone && law.name == "joint_compliance_soft")
    answer.names.push_back("gravity_free");
}

const LawEntry& drawn_law(const Names& names, Group group, int turn) {
  if (!names.empty())
    return *offline::sim::find_law(names[static_cast<std::size_t>(turn) % names.size()]);
  const auto laws = laws_of(group);
  return *laws[static_cast<std::size_t>(turn) % laws.size()];
}

}  // namespace

const std::vector<std::string>& inconvenient_kinds() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> out;
    for (const auto& kind : kinds()) out.push_back(kind.name);
    return out;
  }();
  return names;
}

HiddenCase draw_inconvenient_case(std::uint64_t study_seed, int number) {
  Random random(study_seed * 1000003U + 500000000U + static_cast<std::uint64_t>(number));
  constexpr std::array kTurn = {Group::kNothing, Group::kOne, Group::kNothing, Group::kOne,
                                Group::kUnknown};
  const auto kind_count = kinds().size();
  const auto at = static_cast<std::size_t>(number);
  const Kind& kind = kinds()[at % kind_count];
  const int turn = static_cast<int>(at / kind_count);
  HiddenCase out;
  out.kind = kind.name;
  out.group = kTurn[static_cast<std::size_t>(turn) % kTurn.size()];
  auto& r = out.request;
  r.seed = random.bits() >> 20;
  r.arm = random.below(2) == 0 ? BlindArm::kHeavy : BlindArm::kLight;
  r.sigma_m = one_of(kTrackerSigmas_um, random) * 1e-6;
  r.poses = one_of(kPoseCounts, random);
  r.masses = StatedMasses::kRight;
  if (random.below(2) == 0) r.revisits = r.poses / 10;
  if (kind.make != nullptr) kind.make(out, random);
  const double sigmas = one_of(kEffectSigmas, random);
  if (!kind.own.empty()) {
    // What belongs to the kind is an effect: with another one, smaller, beside it.
    hide_one(*offline::sim::find_law(kind.own), 5.0, random, out);
    const bool alone = out.group == Group::kNothing;
    out.group = Group::kOne;
    if (alone) return out;
    const LawEntry* other = &drawn_law({}, Group::kOne, turn + random.below(20));
    while (other->library == out.hidden.front().names.front())
      other = &drawn_law({}, Group::kOne, random.below(20));
    hide_one(*other, 2.0, random, out);
    return out;
  }
  if (out.group == Group::kNothing) return out;
  const Names& names = out.group == Group::kUnknown ? kind.unknown : kind.laws;
  hide_one(drawn_law(names, out.group, turn + random.below(20)), sigmas, random, out);
  return out;
}

}  // namespace plumb::tests
