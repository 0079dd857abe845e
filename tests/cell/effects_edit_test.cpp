// SPDX-License-Identifier: Apache-2.0
// [effects] is edited where it stands: what was written by hand survives, and what is read back is
// what was asked for.
#include "cell/effects_edit.hpp"

#include <algorithm>
#include <random>

#include "cell/cell.hpp"
#include "support.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::offline {
namespace {

const std::string kRobot =
    "schema = \"cell/1\"   # keep me\n"
    "[robot]\n"
    "dh_convention = \"standard\"\n"
    "joints = [{ name = \"J1\", a = 100, q = [-90, 90] }, { name = \"J2\", q = [-90, 90] },\n"
    "          { name = \"J3\", q = [-90, 90] }]\n";

EffectEntry effect(std::string name, std::vector<int> joints = {},
                   std::map<std::string, EffectEntry::Value> options = {}) {
  return {std::move(name), std::move(joints), std::move(options), {}};
}

const EffectEntry kGeometry = effect("geometry");

std::string edited(const std::string& text, const std::vector<EffectEntry>& wanted) {
  return edited_effects(parse_cell(text, "/c/cell.toml"), wanted);
}

TEST(EffectsEdit, AddsATableAtTheEndOfACellWithoutAny) {
  EXPECT_EQ(edited(kRobot, {kGeometry, effect("joint_compliance", {1})}),
            kRobot + "\n[effects]\n[effects.joint_compliance]\njoints = [\"J2\"]\n");
}

TEST(EffectsEdit, AddsBehindTheOthersAndLeavesTheRestAlone) {
  const std::string before = kRobot +
                             "[effects]  # what the model contains\ngeometry = true\n"
                             "[effects.reversal]  # seen in March\njoints = [\"J1\"]\n"
                             "\n# how it is deployed\n[deploy]\ncycle_us = 4000\n";
  EXPECT_EQ(edited(before, {kGeometry, effect("reversal", {0}), effect("joint_compliance", {1})}),
            kRobot +
                "[effects]  # what the model contains\ngeometry = true\n"
                "[effects.reversal]  # seen in March\njoints = [\"J1\"]\n"
                "[effects.joint_compliance]\njoints = [\"J2\"]\n"
                "\n# how it is deployed\n[deploy]\ncycle_us = 4000\n");
}

TEST(EffectsEdit, ChangesJointsInPlaceAndKeepsTheComment) {
  const std::string before = kRobot + "[effects.reversal]\njoints = [\"J1\"]  # seen in March\n";
  EXPECT_EQ(edited(before, {kGeometry, effect("reversal", {0, 2})}),
            kRobot + "[effects.reversal]\njoints = [\"J1\", \"J3\"]  # seen in March\n");
}

TEST(EffectsEdit, TurnsATableInToAListWhenItGetsCompany) {
  const auto ripple = [](double cycles) {
    return effect("gear_ripple", {1}, {{"cycles_per_turn", cycles}});
  };
  const std::string before =
      kRobot + "[effects.gear_ripple] # the worm\njoints = [\"J2\"]\ncycles_per_turn = 20\n";
  EXPECT_EQ(edited(before, {kGeometry, ripple(20.0), ripple(11.5)}),
            kRobot +
                "[[effects.gear_ripple]] # the worm\njoints = [\"J2\"]\ncycles_per_turn = 20\n"
                "[[effects.gear_ripple]]\njoints = [\"J2\"]\ncycles_per_turn = 11.5\n");
}

TEST(EffectsEdit, RemovesTheTableAndLeavesTheNextOnesComment) {
  const std::string before = kRobot +
                             "[effects.reversal]\njoints = [\"J1\"]\n"
                             "# the payload bends it\n[effects.payload_compliance]\n";
  EXPECT_EQ(edited(before, {kGeometry, effect("payload_compliance")}),
            kRobot + "# the payload bends it\n[effects.payload_compliance]\n");
}

TEST(EffectsEdit, ANumberThatNoDecimalMeetsIsReadBackToTheLastBit) {
  for (const double seconds : {425.52000000000004, 0.1 + 0.2, 1.0 / 3.0, 857.0, 1e-7}) {
    const std::vector<EffectEntry> wanted = {kGeometry,
                                             effect("drift", {}, {{"settling_s", seconds}})};
    const Cell again = parse_cell(edited(kRobot, wanted), "/c/cell.toml");
    EXPECT_EQ(std::get<double>(again.effects.back().options.at("settling_s")), seconds);
  }
}

TEST(EffectsEdit, TakesBackToTheLetterWhatItAdded) {
  for (const std::string gap : {"", "\n", "\n\n", "\n# how it is deployed\n"}) {
    const std::string before =
        kRobot + "[effects]\ngeometry = true\n" + gap + "[deploy]\ncycle_us = 4000\n";
    const std::string more = edited(before, {kGeometry, effect("joint_compliance", {1})});
    EXPECT_EQ(edited(more, {kGeometry}), before);
  }
  const std::string apart =
      kRobot + "\n[effects.reversal]\n\n[effects.drift]\n\n[deploy]\ncycle_us = 4000\n";
  EXPECT_EQ(edited(apart, {kGeometry, effect("reversal")}),
            kRobot + "\n[effects.reversal]\n\n[deploy]\ncycle_us = 4000\n");
}

TEST(EffectsEdit, WritesAFormulaThatIsReadBack) {
  const EffectEntry formula =
      effect("formula", {},
             {{"target", "dq2"},
              {"expression", "k * tau2 * cos(q2)"},
              {"parameters", std::vector<std::string>{"k [rad/(N m)] ~ 1e-6"}},
              {"name", "motor \"heat\""}});
  EffectEntry named = formula;
  named.options["name"] = "motor_heat";
  const Cell back = parse_cell(edited(kRobot, {kGeometry, named}), "/c/cell.toml");
  ASSERT_EQ(back.effects.size(), 2U);
  EXPECT_EQ(back.effects[1].options, named.options);
  EXPECT_EQ(problems_of([&] {
              edited(kRobot, {kGeometry, formula});
            })
                .at(0)
                .code,
            "E-FORMULA-NAME");
}

TEST(EffectsEdit, RefusesALayoutItCannotFollow) {
  const std::string inline_table =
      kRobot.substr(0, kRobot.find("[robot]")) +
      "effects = { geometry = true, reversal = { joints = [\"J1\"] } }\n" +
      kRobot.substr(kRobot.find("[robot]"));
  const auto problems = problems_of([&] {
    edited(inline_table, {kGeometry, effect("reversal", {0}), effect("joint_compliance", {1})});
  });
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].code, "E-CELL-EFFECTS-LAYOUT");
}

/// Any list of effects from any other: read back equal, and every line that is not of [effects]
/// still there, in order. Usage: --count scales it.
TEST(EffectsEdit, IsReadBackAsAskedWhateverWasThere) {
  std::mt19937_64 dice(5);
  const auto any = [&](int n) { return static_cast<int>(dice() % static_cast<unsigned>(n)); };
  const auto list = [&] {
    std::vector<EffectEntry> out{kGeometry};
    if (any(2) == 0) out.push_back(effect("joint_compliance", {any(3)}));
    if (any(2) == 0) out.push_back(effect("payload_compliance"));
    for (int i = any(3); i > 0; --i)
      out.push_back(effect("gear_ripple", {any(3)}, {{"cycles_per_turn", 3.0 * i + 0.5}}));
    if (any(3) == 0) out.push_back(effect("thermal_growth", {}, {{"sensor", "temp_arm"}}));
    std::shuffle(out.begin() + 1, out.end(), dice);
    return out;
  };
  const std::string tail = "# last\n[deploy]\ncycle_us = 2000 # fast\n";
  for (long i = 0; i < tests::scaled(300); ++i) {
    const auto first = list(), second = list();
    const std::string one = edited(kRobot + tail, first);
    const std::string two = edited(one, second);  // throws if it is not read back as asked
    for (const auto& text : {one, two}) {
      EXPECT_TRUE(text.starts_with(kRobot)) << text;
      EXPECT_NE(text.find(tail), std::string::npos) << text;
    }
    EXPECT_EQ(edited(two, second), two) << "not idempotent";
  }
}

}  // namespace
}  // namespace plumb::offline
