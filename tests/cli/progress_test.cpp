// SPDX-License-Identifier: Apache-2.0
#include "cli/progress.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace plumb::offline::cli {
namespace {

using namespace std::chrono_literals;

TEST(Progress, SaysNothingOfWhatTakesLessThanASecond) {
  testing::internal::CaptureStderr();
  {
    Progress progress("fitting");
    progress.at("step 1 of 2");
    std::this_thread::sleep_for(50ms);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Progress, SaysEveryStepOnALineOfItsOwnWhereThereIsNoTerminal) {
  testing::internal::CaptureStderr();
  {
    Progress progress("fitting");
    progress.at("step 1 of 2");
    std::this_thread::sleep_for(2000ms);
    progress.at("step 2 of 2");
    std::this_thread::sleep_for(500ms);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "fitting: step 1 of 2 ...\nfitting: step 2 of 2 ...\n");
}

}  // namespace
}  // namespace plumb::offline::cli
