// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/receive_time.hpp"

#include <gtest/gtest.h>

namespace plumb::drivers {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kDate = 1'700'000'000'000 * kMs;  // of CLOCK_MONOTONIC 0

ClockReading at(std::int64_t monotonic_ms, std::int64_t date_moved_ms = 0) {
  return {.monotonic_ns = monotonic_ms * kMs,
          .date_ns = kDate + (monotonic_ms + date_moved_ms) * kMs};
}

std::int64_t stamp(std::int64_t monotonic_ms, std::int64_t date_moved_ms = 0) {
  return at(monotonic_ms, date_moved_ms).date_ns;
}

TEST(ReceiveTime, IsTheStampOnTheOtherClock) {
  ReceiveTime time(at(100));
  EXPECT_EQ(time.of_frame(stamp(103), at(105)), 103 * kMs);
  EXPECT_EQ(time.jumps(), 0U);
}

TEST(ReceiveTime, IsNeverInTheFutureNorBeforeTheQueueWasEmpty) {
  ReceiveTime time(at(100));
  EXPECT_EQ(time.of_frame(stamp(120), at(105)), 105 * kMs);
  time.saw_empty(at(110));
  EXPECT_EQ(time.of_frame(stamp(50), at(112)), 110 * kMs);
}

TEST(ReceiveTime, OfAFrameWithoutAStampIsWhenTheQueueWasLastEmpty) {
  ReceiveTime time(at(100));
  time.saw_empty(at(108));
  EXPECT_EQ(time.of_frame(0, at(140)), 108 * kMs);
}

TEST(ReceiveTime, IsNeverFresherAfterTheDateWasSet) {
  for (const std::int64_t moved_ms : {-3'600'000, -500, -2, 2, 500, 3'600'000}) {
    ReceiveTime time(at(100));
    time.saw_empty(at(110));
    // stamped at 115, then the date was set, then the frames are taken at 300
    EXPECT_EQ(time.of_frame(stamp(115), at(300, moved_ms)), 110 * kMs) << moved_ms;
    EXPECT_EQ(time.of_frame(stamp(295, moved_ms), at(300, moved_ms)), 110 * kMs) << moved_ms;
    EXPECT_EQ(time.jumps(), 1U);
    time.saw_empty(at(301, moved_ms));
    EXPECT_EQ(time.of_frame(stamp(302, moved_ms), at(304, moved_ms)), 302 * kMs) << moved_ms;
  }
}

TEST(ReceiveTime, TrustsADateThatIsOnlySlewed) {
  ReceiveTime time(at(0));
  time.saw_empty(at(1000));
  const ClockReading slewed = {.monotonic_ns = 11'000 * kMs, .date_ns = kDate + 11'005 * kMs};
  EXPECT_EQ(time.of_frame(slewed.date_ns - 3 * kMs, slewed), 10'997 * kMs);
  EXPECT_EQ(time.jumps(), 0U);
}

TEST(ReceiveTime, CountsAJumpWhileNothingComes) {
  ReceiveTime time(at(0));
  time.saw_empty(at(10, 60'000));
  EXPECT_EQ(time.jumps(), 1U);
  EXPECT_EQ(time.of_frame(stamp(12, 60'000), at(13, 60'000)), 12 * kMs);
}

}  // namespace
}  // namespace plumb::drivers
