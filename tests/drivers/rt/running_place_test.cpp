// SPDX-License-Identifier: Apache-2.0
// The plumb-rt that runs a place is a thread of the test, which holds its lock and answers on its
// socket.
#include "rt/running_place.hpp"

#include <gtest/gtest.h>

#include "program/scratch_folder.hpp"
#include "rt/control_reply.hpp"
#include "tests/drivers/rt/fake_run.hpp"
#include "tests/drivers/rt/problem_of.hpp"

namespace plumb::drivers::rt {
namespace {

using tests::FakeRun;

class RunningPlaces : public testing::Test {
 protected:
  const ScratchFolder scratch{"plumb-place-"};
  const InstallPlace place{scratch.path()};
};

TEST_F(RunningPlaces, NothingRunsWhatNobodyHolds) {
  EXPECT_FALSE(find_running(place).has_value());
  const auto stale = listen_unix(place.folder / "plumb-rt.sock");  // left by a killed run
  EXPECT_FALSE(find_running(place).has_value());
}

TEST_F(RunningPlaces, WhoHoldsItAndDoesNotAnswerIsNotOverlooked) {
  const FolderLock held(place.folder);
  const Problem problem = tests::problem_of([&] { std::ignore = find_running(place); });
  EXPECT_EQ(problem.code, "E-RT-CONTROL");
  EXPECT_NE(problem.message.find(place.folder.filename()), std::string::npos) << problem.message;
}

TEST_F(RunningPlaces, ItsVersionAndItsPackingAreWhatItSays) {
  const Json result{{"install", {{"version", "0123456789abcdef"}}}, {"link", {{"packing", "big"}}}};
  FakeRun run(place, reply({{"ok", true}, {"result", result}}));
  const auto found = find_running(place);
  ASSERT_TRUE(found);
  EXPECT_EQ(run.asked(), "status");
  EXPECT_EQ(found->version, "0123456789abcdef");
  EXPECT_EQ(found->packing, "big");
}

/// Of another version of plumb-rt, or of somebody who put a socket there.
TEST_F(RunningPlaces, AnAnswerThatIsNoneIsRefusedAsSuch) {
  for (const char* const answer :
       {"{\"ok\":1}\n", "{\"ok\":\"true\"}\n", "{\"ok\":true}\n", "{\"ok\":true,\"result\":7}\n",
        "{\"ok\":true,\"result\":{\"install\":\"x\"}}\n",
        "{\"ok\":true,\"result\":{\"install\":{\"version\":5}}}\n",
        "{\"ok\":true,\"result\":{\"link\":[1]}}\n", "{\"ok\":false}\n"}) {
    const FakeRun run(place, answer);
    EXPECT_EQ(tests::problem_of([&] { std::ignore = find_running(place); }).code, "E-RT-CONTROL")
        << answer;
  }
}

TEST_F(RunningPlaces, ASwapReturnsItsChangeOrItsRefusalInTheWordsOfTheRun) {
  const SwapRequest request{.file = "/a b.plumb", .change_m = 0.002};
  {
    FakeRun run(place, reply({{"ok", true}, {"result", {{"change_mm", 1.25}}}}));
    EXPECT_EQ(ask_swap(place, request), 1.25);
    EXPECT_EQ(run.asked(), "swap within_um=2000 /a b.plumb");
  }
  const FakeRun run(place, refusal("E-RT-CHANGE", "too much"));
  const Problem problem = tests::problem_of([&] { std::ignore = ask_swap(place, request); });
  EXPECT_EQ(problem.code, "E-RT-CHANGE");
  EXPECT_EQ(problem.message, "too much");
}

TEST_F(RunningPlaces, ASwapThatIsNotAnsweredByAnAnswerIsRefused) {
  EXPECT_EQ(tests::problem_of([&] { std::ignore = ask_swap(place, {.file = "/x"}); }).code,
            "E-RT-CONTROL");
  for (const char* const answer : {"{\"ok\":1}\n", "{\"ok\":false,\"error\":\"x\"}\n",
                                   "{\"ok\":false,\"error\":{\"code\":5}}\n"}) {
    const FakeRun run(place, answer);
    EXPECT_EQ(tests::problem_of([&] { std::ignore = ask_swap(place, {.file = "/x"}); }).code,
              "E-RT-SWAP")
        << answer;
  }
}

}  // namespace
}  // namespace plumb::drivers::rt
