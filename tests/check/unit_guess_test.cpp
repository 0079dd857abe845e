// SPDX-License-Identifier: Apache-2.0
#include "check/unit_guess.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "cell/units.hpp"

namespace plumb::offline {
namespace {

double metres(const std::string& unit) { return unit_of(unit)->to_si(1.0); }

/// How much longer a file with these units is than its labels say, against its table.
struct Ratios {
  double point, slide, reach_m;
};
Ratios ratios_of(const LengthUnits& labelled, const LengthUnits& real) {
  const double table = metres(real.table) / metres(labelled.table);
  return {metres(real.point) / metres(labelled.point) / table,
          metres(real.slide) / metres(labelled.slide) / table, 1.0 / table};
}

/// An arm of one metre with every choice of labels and of units.
template <class Told>
void for_each_pair(const Told& told) {
  const std::vector<std::string> units = {"mm", "m", "in"};
  for (const auto& a : units)
    for (const auto& b : units)
      for (const auto& c : units)
        for (const auto& d : units)
          for (const auto& e : units)
            for (const auto& f : units) told(LengthUnits{a, b, c}, LengthUnits{d, e, f});
}

int changes(const LengthUnits& a, const LengthUnits& b) {
  return (a.table != b.table) + (a.slide != b.slide) + (a.point != b.point);
}

TEST(UnitGuess, AnyUnitsThatAreFoundGiveTheRatiosThatWereMeasured) {
  for_each_pair([](const LengthUnits& labelled, const LengthUnits& real) {
    const Ratios told = ratios_of(labelled, real);
    const Ratios got =
        ratios_of(labelled, explain_ratios(labelled, told.point, told.slide, told.reach_m));
    EXPECT_NEAR(got.point / told.point, 1.0, 1e-9);
    EXPECT_NEAR(got.slide / told.slide, 1.0, 1e-9);
  });
}

TEST(UnitGuess, OneWrongLabelIsFoundAndRightOnesStay) {
  for_each_pair([](const LengthUnits& labelled, const LengthUnits& real) {
    if (changes(labelled, real) > 1) return;
    const Ratios told = ratios_of(labelled, real);
    const LengthUnits got = explain_ratios(labelled, 1.03 * told.point, told.slide, told.reach_m);
    EXPECT_EQ(changes(got, real), 0) << labelled.table << labelled.slide << labelled.point << " "
                                     << got.table << got.slide << got.point;
  });
}

TEST(UnitGuess, RatiosOfNoUnitsLeaveTheLabels) {
  const LengthUnits labelled{"mm", "in", "m"};
  for (const double ratio : {1.2, 7.3, 300.0, 0.5})
    EXPECT_EQ(changes(explain_ratios(labelled, ratio, 0.0, 1.0), labelled), 0) << ratio;
}

TEST(UnitGuess, EveryRatioOfUnitsHasItsInverse) {
  const auto& all = length_ratios();
  EXPECT_EQ(all.front(), 1.0);
  for (const double ratio : all)
    EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](double other) {
      return std::abs(ratio * other - 1.0) < 1e-12;
    })) << ratio;
}

TEST(UnitGuess, AnArmOfAnotherDecadeIsThreeChangesOddEitherWay) {
  EXPECT_EQ(oddity(1.0), 0.0);
  for (const double reach : {6.0, 30.0, 1000.0}) {
    EXPECT_NEAR(oddity(10.0 * reach), oddity(reach) + 3.0, 1e-9);
    EXPECT_NEAR(oddity(1.0 / reach), oddity(reach), 1e-9);
  }
}

/// A full turn may be written either way; a hundred are degrees, a hundredth of one are radians.
TEST(UnitGuess, AnglesAreReadInTheUnitsInWhichAnArmCanHaveThem) {
  const auto units = [](double number, const std::string& label) {
    const auto all = plausible_turn_units(unit_of(label)->to_si(number), label);
    EXPECT_EQ(all.front(), label);
    const std::set<std::string> out(all.begin(), all.end());
    EXPECT_EQ(out.size(), all.size());
    return out;
  };
  const std::set<std::string> both = {"deg", "rad"};
  for (const char* label : {"deg", "rad"}) {
    EXPECT_EQ(units(6.3, label), both);
    EXPECT_EQ(units(180.0, label), std::set<std::string>({"deg", label}));
    EXPECT_EQ(units(1.5, label), std::set<std::string>({"rad", label}));
  }
}

}  // namespace
}  // namespace plumb::offline
