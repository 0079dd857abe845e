// SPDX-License-Identifier: Apache-2.0
#include "rt/stop_signal.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cstring>

#include "program/problem.hpp"
#include "tests/drivers/child.hpp"

namespace plumb::drivers::rt {
namespace {

/// Lives as long as the program, as stop_on_signal() asks.
std::atomic<bool> stop_asked{false};

TEST(StopSignal, TheFirstOneAsksTheSecondOneEndsWhicheverTheyAre) {
  for (const int first : {SIGTERM, SIGINT})
    for (const int second : {SIGTERM, SIGINT}) {
      EXPECT_EQ(tests::in_child([&] {
                  stop_on_signal(stop_asked);
                  if (stop_asked) return 1;
                  ::raise(first);
                  return stop_asked ? 2 : 3;
                }),
                2)
          << "it goes on, to ramp out";
      EXPECT_EQ(tests::in_child([&] {
                  stop_on_signal(stop_asked);
                  ::raise(first);
                  ::raise(second);
                  return 4;
                }),
                static_cast<int>(Exit::kInterrupted));
    }
}

TEST(StopSignal, AReaderOfItsWordsWhoLeavesEndsNothing) {
  EXPECT_EQ(tests::in_child([] {
              stop_on_signal(stop_asked);
              int ends[2];
              if (::pipe(ends) != 0) return 1;
              ::close(ends[0]);
              return ::write(ends[1], "x", 1) < 0 && !stop_asked ? 2 : 3;
            }),
            2);
}

TEST(StopSignal, TheLastWordsOfTheProgramAreSaid) {
  EXPECT_EQ(tests::in_child([] {
              struct sigaction last {};
              last.sa_handler = [](int) { ::_exit(99); };
              ::sigaction(SIGTERM, &last, nullptr);
              stop_on_signal(stop_asked);
              ::raise(SIGINT);
              ::raise(SIGTERM);
              return 1;
            }),
            99);
}

}  // namespace
}  // namespace plumb::drivers::rt
