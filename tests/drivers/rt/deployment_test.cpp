// SPDX-License-Identifier: Apache-2.0
#include "rt/deployment.hpp"

#include <gtest/gtest.h>

#include "tests/drivers/deployed.hpp"
#include "tests/drivers/rt/problem_of.hpp"

namespace plumb::drivers::rt {
namespace {

std::string code_of_loading(const tests::Deployed& folder, Sums sums = Sums::kVerified) {
  return tests::problem_of([&] { std::ignore = load_deployment(folder.folder, sums); }).code;
}

/// A parser is no judge of what nobody has listed.
TEST(Deployments, WhatIsNotListedIsRefusedBeforeItIsParsed) {
  for (const char* const name : {"rt.toml", "robot.plumb"}) {
    const tests::Deployed folder;
    ASSERT_EQ(code_of_loading(folder), "");
    std::ofstream(folder.folder / name) << "no such thing";
    EXPECT_EQ(code_of_loading(folder), "E-RT-SUMS") << name;
    const std::string parsed = code_of_loading(folder, Sums::kIgnored);
    EXPECT_TRUE(parsed == "E-TOML" || parsed == "E-RT-MODEL") << parsed;
  }
}

TEST(Deployments, EveryLimitThatIsWiderThanItsCeilingIsRefusedByItsKeyInOneFailure) {
  const tests::Deployed folder;
  const Deployment found = load_deployment(folder.folder);
  Ceilings narrow = found.config.ceilings;
  narrow.correction_m = narrow.slew_m_s = 1e-6;
  narrow.ramp_s = 10.0;
  try {
    refuse_wider("better.plumb", *found.model.loaded, narrow, folder.folder);
    FAIL() << "it was not refused";
  } catch (const Failure& failure) {
    ASSERT_EQ(failure.problems().size(), 3U);
    std::string all;
    for (const Problem& problem : failure.problems()) {
      EXPECT_EQ(problem.code, "E-RT-CEILING");
      EXPECT_NE(problem.message.find("better.plumb"), std::string::npos) << problem.message;
      all += problem.message;
    }
    for (const char* const key : {"max_correction_mm", "max_slew_mm_s", "min_ramp_s"})
      EXPECT_NE(all.find(key), std::string::npos) << all;
  }
  refuse_wider("better.plumb", *found.model.loaded, found.config.ceilings, folder.folder);
}

/// Classic CAN carries the lower bits of a counter only, and Modbus is no CAN at all.
TEST(Deployments, ARecordHoldsWhatItsBusCarries) {
  const tests::Deployed folder;
  const BusLayout record = record_layout(load_deployment(folder.folder));
  EXPECT_EQ(record.can_format, CanFrame::Format::kFd);
}

TEST(Deployments, AModelThatReplacesItIsReadFromItsOwnFileForItsOwnRobot) {
  const tests::Deployed folder;
  NextModel next{.file = folder.folder / "robot.plumb",
                 .serial = "UR-1",
                 .etc = folder.folder / "no-etc",
                 .place = {},
                 .written = {}};
  EXPECT_EQ(load_next_model(next).sha256, load_deployment(folder.folder).model.sha256);
  next.serial = "UR-2";
  EXPECT_EQ(tests::problem_of([&] { std::ignore = load_next_model(next); }).code, "E-RT-SERIAL");
  next.serial = "UR-1";
  next.place = folder.folder;  // a place, of which this file is in no version
  EXPECT_EQ(tests::problem_of([&] { std::ignore = load_next_model(next); }).code, "E-RT-SWAP");
}

}  // namespace
}  // namespace plumb::drivers::rt
