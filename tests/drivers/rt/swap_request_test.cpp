// SPDX-License-Identifier: Apache-2.0
#include "rt/swap_request.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "rt/screen_units.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::drivers::rt {
namespace {

constexpr std::string_view kSwap = "swap ";

SwapRequest again(const SwapRequest& request) {
  const std::string line = swap_line(request);
  EXPECT_TRUE(line.starts_with(kSwap)) << line;
  return read_swap(line.substr(kSwap.size()));
}

TEST(SwapRequests, WhatIsAskedIsWhatIsReadForEveryNameAndEveryAllowance) {
  tests::Random random(7);
  for (const std::string file : {"/a", "/with space/b c.plumb", "/within_um=5 x", "/\xff", "/a=b"})
    for (int i = 0; i < 50; ++i) {
      const double allowed_m = i == 0 ? 0.0 : random.uniform(1e-6, 0.05);
      const SwapRequest read = again({.file = file, .change_m = allowed_m});
      EXPECT_EQ(read.file, file);
      EXPECT_NEAR(read.change_m, allowed_m, 0.51e-6);
    }
}

/// Who forges an allowance gets none: what cannot be read is the name of a file that is not there.
TEST(SwapRequests, AnAllowanceThatIsNoNumberAllowsNothing) {
  for (const std::string words :
       {"within_um= /x", "within_um=nan /x", "within_um=inf /x", "within_um=-1e9 /x",
        "within_um=1e999 /x", "within_um=5", "within_um=5/x", "within_um=0x10 /x",
        "within_um=", " within_um=5 /x"})
    EXPECT_EQ(read_swap(words).change_m, 0.0) << words;
}

ModelChange change(double position_m, double rotation_rad) {
  return {.position_m = position_m, .rotation_rad = rotation_rad, .q = {}, .compared = 1};
}

TEST(SwapRequests, AChangeIsRefusedFromItsCeilingOnInBothUnits) {
  const Ceilings ceilings;
  const double just_below = 1.0 - 1e-9, just_above = 1.0 + 1e-9;
  const auto fault = [&](double position, double rotation) {
    return change_fault(change(position * ceilings.change_m, rotation * ceilings.change_rad), {},
                        ceilings);
  };
  EXPECT_EQ(fault(just_below, just_below), "");
  EXPECT_NE(fault(just_above, just_below).find("mm"), std::string::npos);
  EXPECT_NE(fault(just_below, just_above).find("deg"), std::string::npos);
}

TEST(SwapRequests, ModelsThatCouldNotBeComparedAreRefusedHoweverMuchIsAllowed) {
  ModelChange none = change(0.0, 0.0);
  none.compared = 0;
  EXPECT_NE(change_fault(none, {.file = "/x", .change_m = 1.0}, {}), "");
}

/// The message ends in what would allow the change, over the line that the operator's command
/// sends.
TEST(SwapRequests, WhoFollowsTheAdviceIsNotRefusedAgain) {
  constexpr std::string_view kAdvice = "--allow-change-mm ";
  const Ceilings ceilings;
  tests::Random random(8);
  for (long i = 0; i < tests::scaled(1000); ++i) {
    const ModelChange big = change(ceilings.change_m * random.uniform(1.0001, 30.0), 0.0);
    const std::string fault = change_fault(big, {}, ceilings);
    const std::size_t at = fault.find(kAdvice);
    ASSERT_NE(at, std::string::npos) << fault;
    const double advised_mm = std::atof(fault.c_str() + at + kAdvice.size());
    EXPECT_LT(advised_mm * kMilli, 1.06 * big.position_m + 2e-6) << "and not much more";
    const SwapRequest allowed = again({.file = "/x", .change_m = advised_mm * kMilli});
    EXPECT_EQ(change_fault(big, allowed, ceilings), "");
  }
}

TEST(SwapRequests, AnAllowanceNeverNarrowsAndWidensRotationsByTheSameFactor) {
  const Ceilings ceilings;
  const ModelChange within = change(0.9 * ceilings.change_m, 0.9 * ceilings.change_rad);
  for (const double share : {0.0, 0.1, 1.0, 3.0}) {
    const SwapRequest request{.file = "/x", .change_m = share * ceilings.change_m};
    EXPECT_EQ(change_fault(within, request, ceilings), "") << share;
    const double turns = std::max(1.0, share) * ceilings.change_rad;
    EXPECT_EQ(change_fault(change(0.0, 0.999 * turns), request, ceilings), "") << share;
    EXPECT_NE(change_fault(change(0.0, 1.001 * turns), request, ceilings), "") << share;
  }
}

}  // namespace
}  // namespace plumb::drivers::rt
