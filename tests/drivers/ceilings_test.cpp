// SPDX-License-Identifier: Apache-2.0
// A model may do no more to the robot than the machine allows.
#include "rt/ceilings.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "program/problem.hpp"

namespace plumb::drivers::rt {
namespace {

using format::GuardLimits;

/// The limits of a model that are just those of the machine.
GuardLimits at(const Ceilings& ceilings) {
  GuardLimits out;
  out.corrects = format::Corrects::kPose;
  out.max_correction_m = ceilings.correction_m;
  out.max_rotation_rad = ceilings.rotation_rad;
  out.slew_m_per_s = ceilings.slew_m_s;
  out.slew_rad_per_s = ceilings.slew_rad_s;
  out.ramp_s = ceilings.ramp_s;
  return out;
}

struct Limit {
  const char* key;
  double GuardLimits::*value;
  double wider;  // factor
};
constexpr Limit kLimits[] = {{"max_correction_mm", &GuardLimits::max_correction_m, 1.01},
                             {"max_slew_mm_s", &GuardLimits::slew_m_per_s, 1.01},
                             {"max_rotation_deg", &GuardLimits::max_rotation_rad, 1.01},
                             {"max_slew_deg_s", &GuardLimits::slew_rad_per_s, 1.01},
                             {"min_ramp_s", &GuardLimits::ramp_s, 0.99}};

Ceilings read(const std::string& text) {
  TomlSource source("rt.toml", text, "E-RT");
  const toml::table root = source.parse();
  TomlTable table(root, "limits", source);
  Ceilings out;
  read_ceilings(table, out);
  table.done();
  source.stop_on_errors();
  return out;
}

TEST(RtCeilings, AModelAtItsCeilingsIsNotWider) {
  const Ceilings ceilings;
  EXPECT_TRUE(wider_limits(at(ceilings), ceilings).empty());
}

TEST(RtCeilings, EveryLimitThatIsWiderIsNamedAloneAndInItsUnit) {
  const Ceilings ceilings;
  for (const Limit& limit : kLimits) {
    GuardLimits model = at(ceilings);
    model.*limit.value *= limit.wider;
    const auto wider = wider_limits(model, ceilings);
    ASSERT_EQ(wider.size(), 1U) << limit.key;
    EXPECT_STREQ(wider[0].key, limit.key);
    EXPECT_NEAR(wider[0].model / wider[0].ceiling, limit.wider, 1e-9);
    const std::string text = wider[0].text();
    EXPECT_NE(text.find(limit.key), std::string::npos) << text;
  }
}

TEST(RtCeilings, ALimitThatIsNoNumberIsWider) {
  for (const Limit& limit : kLimits) {
    GuardLimits model = at({});
    model.*limit.value = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(wider_limits(model, {}).size(), 1U) << limit.key;
  }
}

TEST(RtCeilings, NarrowerLimitsNeverMakeAModelWider) {
  const Ceilings ceilings;
  for (double share = 1.0; share > 1e-3; share *= 0.5) {
    GuardLimits model = at(ceilings);
    for (const Limit& limit : kLimits)
      model.*limit.value *= limit.wider > 1.0 ? share : 1.0 / share;
    EXPECT_TRUE(wider_limits(model, ceilings).empty());
  }
}

TEST(RtCeilings, RotationsCountOnlyForAModelThatCorrectsThem) {
  GuardLimits model = at({});
  model.max_rotation_rad = model.slew_rad_per_s = 10.0;
  EXPECT_EQ(wider_limits(model, {}).size(), 2U);
  model.corrects = format::Corrects::kPosition;
  EXPECT_TRUE(wider_limits(model, {}).empty());
}

/// `plumb deploy` states ten digits: what is read back from them never refuses the model that they
/// were written for.
TEST(RtCeilings, WhatIsReadBackFromItsDigitsLetsItsOwnModelPass) {
  for (const double correction_mm : {0.1, 0.3, 1.0 / 3.0, 3.0, 7.7}) {
    GuardLimits model = at({});
    model.max_correction_m = correction_mm * 1e-3;
    const Ceilings ceilings =
        read(fmt::format("max_correction_mm = {:.10g}\n", model.max_correction_m * 1e3));
    EXPECT_TRUE(wider_limits(model, ceilings).empty()) << correction_mm;
  }
}

TEST(RtCeilings, AbsentKeysChangeNothing) {
  const Ceilings usual, read_none = read("");
  EXPECT_EQ(read_none.correction_m, usual.correction_m);
  EXPECT_EQ(read_none.ramp_s, usual.ramp_s);
  const Ceilings one = read("max_slew_mm_s = 12\n");
  EXPECT_NEAR(one.slew_m_s, 0.012, 1e-12);
  EXPECT_EQ(one.correction_m, usual.correction_m);
  EXPECT_EQ(one.slew_rad_s, usual.slew_rad_s);
}

TEST(RtCeilings, ACeilingThatIsNoneIsRefused) {
  for (const char* text : {"max_correction_mm = 51", "max_correction_mm = 0", "max_slew_mm_s = -1",
                           "max_rotation_deg = 91", "min_ramp_s = nan", "max_change_mm = inf"})
    EXPECT_THROW(read(text), Failure) << text;
}

}  // namespace
}  // namespace plumb::drivers::rt
