// SPDX-License-Identifier: Apache-2.0
// Effects that no arm has: numbers beyond what is credible, and motions beyond what works.
#include "check/effect_sense.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "arm/effect_binding.hpp"
#include "arm/parameter.hpp"
#include "cell/effect_option.hpp"
#include "effects/registry.hpp"
#include "tests/check/simulated_arm.hpp"

namespace plumb::offline {
namespace {

Cell cell_with(const std::string& effect, const EffectOption& option, double value) {
  Cell out = six_joint_cell(1);
  EffectEntry entry{.name = effect, .joints = {}, .options = {}, .place = {}};
  entry.place.line = 77;
  set_option(entry, option.key, value);
  out.effects = {entry};
  return out;
}

/// The next number, in the direction of `to`.
double beside(double value, double to) { return std::nextafter(value, to); }

TEST(OptionFindings, AreSaidOfNumbersBeyondTheCredibleOnesAndOfNoOthers) {
  int limits = 0;
  for (const EffectDescriptor* effect : effect_descriptors()) {
    const std::string name(effect->name);
    for (const EffectOption& option : options_of(effect->name)) {
      const auto said = [&](double value) {
        return option_findings(cell_with(name, option, value));
      };
      for (const double limit : {option.credible_least, option.credible_most}) {
        if (!std::isfinite(limit)) continue;
        ++limits;
        const double out = limit == option.credible_least ? -HUGE_VAL : HUGE_VAL;
        EXPECT_TRUE(said(limit).empty()) << name << " " << option.name();
        EXPECT_TRUE(said(beside(limit, -out)).empty()) << name << " " << option.name();
        const auto found = said(beside(limit, out));
        ASSERT_EQ(found.size(), 1U) << name << " " << option.name();
        EXPECT_EQ(found.front().code, "W-CHECK-EFFECT");
        EXPECT_TRUE(holds(found.front().message, option.name())) << found.front().message;
        ASSERT_TRUE(found.front().place);
        EXPECT_EQ(found.front().place->line, 77);
        EXPECT_FALSE(found.front().help.empty()) << name << " " << option.name();
      }
    }
  }
  EXPECT_GE(limits, 3) << "reference temperature, reversal, drift";
}

TEST(OptionFindings, AreNoneOfWhatIsNotStated) {
  Cell cell = six_joint_cell(1);
  for (const EffectDescriptor* effect : effect_descriptors())
    cell.effects.push_back(
        {.name = std::string(effect->name), .joints = {}, .options = {}, .place = {}});
  EXPECT_TRUE(option_findings(cell).empty());
}

/// A fitted arm whose first joint turns by `size` times the sine of its angle too far.
struct Swaying {
  explicit Swaying(double size) {
    const EffectEntry gear{.name = "gear_harmonics", .joints = {0}, .options = {}, .place = {}};
    state.arm.calibrated = at.cell.nominal;
    state.arm.effects = {bind_effect(at.cell, at.measured, gear)};
    state.arm.effects.front().parameters.front() = size;
    for (int i = 0; i < at.measured.size(); ++i) {
      const double turn = size * std::sin(at.measured.q(i, 0));
      most = std::max(most, std::abs(turn) * radius(i));
    }
  }
  std::vector<Problem> said() const {
    return effect_size_findings(at.cell, at.measured, at.rows, state);
  }
  /// Distance of the tool from the first axis, which passes through the base.
  double radius(int row) const {
    ArmState plain;
    plain.arm.calibrated = at.cell.nominal;
    const RowsN q = at.measured.q.row(row);
    const Chain chain(plain.arm.calibrated);
    const std::span<const double> joints(q.data(), static_cast<std::size_t>(q.cols()));
    const Transformd X_BT = chain.forward(joints);
    return std::hypot(X_BT.p.x(), X_BT.p.y());
  }

  SimulatedArm at = simulated_arm(3, 80, 0.0);
  ArmState state;
  double most = 0.0;  // [m]
};

TEST(EffectSizeFindings, AreSaidBeyondTwoHundredthsOfTheReach) {
  const Swaying unit(1e-3);
  const double limit = 0.02 * reach(unit.at.cell.nominal);
  const double size = 1e-3 * limit / unit.most;  // at the limit, as far as turns are small
  EXPECT_TRUE(Swaying(0.5 * size).said().empty());
  EXPECT_TRUE(Swaying(0.95 * size).said().empty());
  const auto found = Swaying(1.05 * size).said();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(holds(found.front().message, "effect gear_harmonics moves")) << found.front().message;
  EXPECT_TRUE(holds(found.front().help, "plumb drop gear_harmonics")) << found.front().help;
}

TEST(EffectSizeFindings, NameTheEffectThatIsTooLargeAmongOthers) {
  Swaying arm(1e-3);
  const double limit = 0.02 * reach(arm.at.cell.nominal);
  arm.state = Swaying(2e-3 * limit / arm.most).state;
  EffectEntry other{.name = "gear_harmonics", .joints = {1}, .options = {}, .place = {}};
  arm.state.arm.effects.push_back(bind_effect(arm.at.cell, arm.at.measured, other));
  arm.state.arm.effects.back().parameters.front() = 1e-5;
  EXPECT_EQ(arm.said().size(), 1U);
}

}  // namespace
}  // namespace plumb::offline
