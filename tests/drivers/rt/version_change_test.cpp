// SPDX-License-Identifier: Apache-2.0
// The order of a change, seen by the plumb-rt that runs: here a thread of the test.
#include "rt/version_change.hpp"

#include <gtest/gtest.h>

#include "rt/control_reply.hpp"
#include "tests/drivers/rt/fake_run.hpp"
#include "tests/drivers/rt/folder_text.hpp"
#include "tests/drivers/rt/placed.hpp"
#include "tests/drivers/rt/problem_of.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;
using tests::FakeRun;
using Running = ChangeRequest::Running;

/// A place with three versions: `first` is current, `second` has another model, `third` another
/// configuration as well.
class VersionChanges : public testing::Test {
 protected:
  VersionChanges() {
    const tests::Deployed one, two, three;
    two.write_model("robot.plumb", tests::arm_shifted(1e-4));
    three.write_model("robot.plumb", tests::arm_shifted(2e-4));
    three.write("rt.toml", tests::Deployed::csv("limited_scale = 0.5\n"));
    first = placed.add(one);
    second = placed.add(two);
    third = placed.add(three);
    placed.make_current(first);
    append_history(placed.place, history_line("install", first, ""));
  }
  /// The answers of a run whose model is that of this version.
  static std::string status_of(const std::string& version) {
    return reply({{"ok", true}, {"result", {{"install", {{"version", version}}}}}});
  }
  static bool is_swap(const std::string& asked) { return asked.starts_with("swap "); }
  static FakeRun::Answer running(const std::string& version, std::function<std::string()> swap) {
    return [=](const std::string& asked) { return is_swap(asked) ? swap() : status_of(version); };
  }
  static std::string swapped() { return reply({{"ok", true}, {"result", {{"change_mm", 0.25}}}}); }
  Changed change_to(const std::string& id, Running how = Running::kSwap) const {
    const ChangeRequest request{.place = placed.place, .etc = placed.etc, .running = how};
    const PlaceBefore before{.current = first, .history = read_history(placed.place, first)};
    return VersionChange(request, before, history_line("install", id, first)).make();
  }
  std::string history() const { return tests::whole_text(placed.place.history()); }
  static bool has(const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
  }
  std::string model_of(const std::string& id) const {
    return (fs::absolute(placed.place.version(id)) / "robot.plumb").string();
  }

  tests::Placed placed;
  std::string first, second, third;
};

TEST_F(VersionChanges, WhereNothingRunsTheNextStartRunsIt) {
  for (const Running how : {Running::kSwap, Running::kRestart}) {
    placed.make_current(first);
    const Changed changed = change_to(third, how);
    EXPECT_EQ(changed.line.how, "stopped");
    EXPECT_FALSE(changed.nothing);
    EXPECT_EQ(changed.change_mm, 0.0);
    EXPECT_EQ(placed.current(), third);
    EXPECT_EQ(read_history(placed.place, third).lines.back().version, third);
  }
}

TEST_F(VersionChanges, WhatIsCurrentAlreadyChangesNothing) {
  const auto before = tests::folder_text(placed.place.folder);
  EXPECT_TRUE(change_to(first).nothing);
  EXPECT_EQ(tests::folder_text(placed.place.folder), before);
  const FakeRun run(placed.place, running(first, swapped));
  EXPECT_TRUE(change_to(first).nothing) << "and it runs";
  EXPECT_EQ(history(), before.at("installs.jsonl").substr(std::string("holds ").size()));
}

/// What runs is asked between the line and the link: a refusal must find the old version current,
/// and a program that is killed then must have left its line.
TEST_F(VersionChanges, WhatRunsIsAskedAfterTheLineIsWrittenAndBeforeItIsCurrent) {
  std::string current_then, history_then;
  FakeRun run(placed.place, running(first, [&] {
                current_then = placed.current();
                history_then = history();
                return swapped();
              }));
  const Changed changed = change_to(second);
  EXPECT_EQ(changed.line.how, "swapped");
  EXPECT_EQ(changed.change_mm, 0.25);
  EXPECT_EQ(run.asked(), "swap " + model_of(second));
  EXPECT_EQ(current_then, first);
  EXPECT_TRUE(has(history_then, second)) << history_then;
  EXPECT_EQ(placed.current(), second);
}

TEST_F(VersionChanges, WhatIsRefusedNeverBecomesCurrentAndItsLineIsTakenBack) {
  FakeRun run(placed.place,
              running(first, [] { return refusal("E-RT-CHANGE", "the change is too much"); }));
  const Problem problem = tests::problem_of([&] { std::ignore = change_to(second); });
  EXPECT_EQ(problem.code, "E-RT-CHANGE");
  EXPECT_EQ(placed.current(), first);
  const History left = read_history(placed.place, first);
  ASSERT_EQ(left.lines.size(), 1U);
  EXPECT_EQ(left.lines[0].version, first);
  EXPECT_EQ(left.cut_off, "");
  EXPECT_TRUE(has(history(), "the change is too much")) << "it says why";
}

TEST_F(VersionChanges, WhatDiffersInMoreThanItsModelIsRefusedBeforeAnythingIsWritten) {
  const std::string before = history();
  FakeRun run(placed.place, running(first, swapped));
  const Problem problem = tests::problem_of([&] { std::ignore = change_to(third); });
  EXPECT_EQ(problem.code, "E-RT-RESTART");
  EXPECT_TRUE(has(problem.message, "limited_scale")) << problem.message;
  EXPECT_TRUE(has(problem.help, "--at-restart")) << problem.help;
  for (const std::string& asked : run.all_asked()) EXPECT_FALSE(is_swap(asked)) << asked;
  EXPECT_EQ(placed.current(), first);
  EXPECT_EQ(history(), before);
}

TEST_F(VersionChanges, AModelThatIsNoVersionIsRefusedToo) {
  FakeRun run(placed.place, running("", swapped));
  EXPECT_EQ(tests::problem_of([&] { std::ignore = change_to(second); }).code, "E-RT-RESTART");
  EXPECT_EQ(placed.current(), first);
}

TEST_F(VersionChanges, AtARestartWhatRunsIsNotEvenAsked) {
  FakeRun run(placed.place, running(first, swapped));
  const Changed changed = change_to(third, Running::kRestart);
  EXPECT_EQ(changed.line.how, "at-restart");
  EXPECT_TRUE(run.all_asked().empty());
  EXPECT_EQ(placed.current(), third);
}

TEST_F(VersionChanges, AnotherModelThatRunsIsSwappedBackToWhatIsCurrentWithoutALine) {
  const std::string before = history();
  FakeRun run(placed.place, running(second, swapped));
  const Changed changed = change_to(first);
  EXPECT_FALSE(changed.nothing);
  EXPECT_EQ(run.asked(), "swap " + model_of(first));
  EXPECT_EQ(placed.current(), first);
  EXPECT_EQ(history(), before);
}

/// The disk fails at the last step: what runs must not be another model than what is current.
TEST_F(VersionChanges, IfTheLinkCannotBeRenamedTheModelBeforeComesBack) {
  FakeRun run(placed.place, running(first, [&] {
                if (fs::is_symlink(placed.place.link())) fs::remove(placed.place.link());
                fs::create_directories(placed.place.link() / "in the way");
                return swapped();
              }));
  EXPECT_EQ(tests::problem_of([&] { std::ignore = change_to(second); }).code, "E-WRITE");
  std::vector<std::string> swaps;
  for (const std::string& asked : run.all_asked())
    if (is_swap(asked)) swaps.push_back(asked);
  ASSERT_EQ(swaps.size(), 2U);
  EXPECT_TRUE(swaps[0].ends_with(model_of(second))) << swaps[0];
  EXPECT_TRUE(swaps[1].ends_with(model_of(first))) << swaps[1];
  EXPECT_GE(read_swap(swaps[1].substr(5)).change_m, 0.1) << "however much that changes";
  EXPECT_TRUE(has(history(), "\"refused\""));
}

}  // namespace
}  // namespace plumb::drivers::rt
