// SPDX-License-Identifier: Apache-2.0
// What is kept of the seconds around a fault, and what the metrics' example alerts rest on.
#include "rt/snapshots.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>

#include "program/scratch_folder.hpp"
#include "rt/status_text.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kOneSecond_ns = 1'000'000'000;

class SnapshotFiles : public testing::Test {
 protected:
  SnapshotFiles() {
    settings.snapshots = 3;
    settings.before_s = 10.0;
    settings.after_s = 5.0;
  }
  /// A second of the record is a line with its number; every fifth one begins with a copy.
  void go(Snapshots& to, int seconds) {
    for (int i = 0; i < seconds; ++i) {
      ++second;
      if (second % 5 == 1) to.begin("copy\n", now());
      to.add(std::to_string(second) + "\n");
      to.tend(now());
    }
  }
  fs::path make(Snapshots& in, const std::string& reason) {
    return in.make(reason, now(), 1'795'599'012'123 + 1000LL * second);
  }
  std::int64_t now() const { return second * kOneSecond_ns; }
  static std::string text(const fs::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::set<std::string> reasons() const {
    std::set<std::string> out;
    for (const auto& entry : fs::directory_iterator(folder / "snapshots"))
      if (is_snapshot(entry.path().filename()))
        out.insert(entry.path().filename().string().substr(21));
    return out;
  }
  std::size_t files() const {
    std::size_t out = 0;
    for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder / "snapshots")) ++out;
    return out;
  }

  ScratchFolder scratch{"plumb-snapshots-"};
  const fs::path& folder = scratch.path();
  RecordSettings settings;
  int second = 0;
};

TEST_F(SnapshotFiles, HoldTheSecondsBeforeAndAfter) {
  Snapshots snapshots(settings, folder / "snapshots");
  go(snapshots, 57);
  const fs::path file = make(snapshots, "fault-pose-mismatch");
  EXPECT_EQ(file.filename(), "20261125T093109.123Z-fault-pose-mismatch.log");
  go(snapshots, 20);
  const std::string lines = text(file);
  EXPECT_EQ(lines.rfind("copy\n", 0), 0U) << "a replay can begin with it";
  EXPECT_NE(lines.find("\n47\n"), std::string::npos) << lines;
  EXPECT_EQ(lines.find("\n40\n"), std::string::npos) << "no more than a copy's distance: " << lines;
  EXPECT_NE(lines.find("\n62\n"), std::string::npos) << lines;
  EXPECT_EQ(lines.find("\n64\n"), std::string::npos) << lines;
  EXPECT_EQ(snapshots.failure(), "");
}

TEST_F(SnapshotFiles, TheOldestGoAndHoldsRemoveNoFault) {
  Snapshots snapshots(settings, folder / "snapshots");
  fs::create_directory(folder / "snapshots");
  std::ofstream(folder / "snapshots" / "notes.txt") << "an operator's own\n";
  go(snapshots, 5);
  for (const char* const fault : {"fault-a", "fault-b", "fault-c", "fault-d"}) {
    EXPECT_NE(make(snapshots, fault), fs::path());
    go(snapshots, 10);
  }
  for (int i = 0; i < 20; ++i) {
    EXPECT_NE(make(snapshots, "hold-target"), fs::path());
    go(snapshots, 10);
  }
  EXPECT_EQ(files(), 3U + 3U + 1U);
  const auto left = reasons();
  EXPECT_EQ(left.count("fault-a.log"), 0U);
  for (const char* const fault : {"fault-b.log", "fault-c.log", "fault-d.log"})
    EXPECT_EQ(left.count(fault), 1U) << fault;
  EXPECT_EQ(snapshots.made(), 24U);
}

TEST_F(SnapshotFiles, AStormForOneReasonMakesOneFileOfBoundedLength) {
  Snapshots snapshots(settings, folder / "snapshots");
  go(snapshots, 5);
  const fs::path file = make(snapshots, "hold-joints");
  for (int i = 0; i < 58; ++i) {  // the last one would reach to the 68th second
    go(snapshots, 1);
    EXPECT_EQ(make(snapshots, "hold-joints"), fs::path());
  }
  go(snapshots, 100);
  EXPECT_EQ(files(), 1U);
  EXPECT_NE(text(file).find("\n64\n"), std::string::npos);
  EXPECT_EQ(text(file).find("\n67\n"), std::string::npos) << "a minute at most";
}

TEST_F(SnapshotFiles, AFolderThatCannotBeMadeIsSaid) {
  Snapshots snapshots(settings, folder / "gone" / "snapshots");
  go(snapshots, 5);
  EXPECT_EQ(make(snapshots, "fault-a"), fs::path());
  EXPECT_NE(snapshots.failure().find("No such file or directory"), std::string::npos)
      << snapshots.failure();
  fs::create_directory(folder / "gone");
  EXPECT_NE(make(snapshots, "fault-a"), fs::path());
  EXPECT_EQ(snapshots.failure(), "");
}

TEST(SnapshotReason, IsAFaultOrAnInputThatNobodySwitchesOff) {
  using enum SessionState;
  const auto reason = [](SessionState before, SessionState after, Lost lost) {
    return snapshot_reason(
        before, {.tick = {}, .state = after, .cause = FaultCause::kOtherRobot, .lost = lost});
  };
  EXPECT_EQ(reason(kActive, kFault, Lost::kNothing), "fault-other-robot");
  EXPECT_EQ(reason(kInit, kFault, Lost::kJoints), "fault-other-robot");
  EXPECT_EQ(reason(kFault, kFault, Lost::kNothing), "");
  EXPECT_EQ(reason(kActive, kHold, Lost::kDrives | Lost::kJoints), "hold-joints");
  EXPECT_EQ(reason(kActive, kHold, Lost::kStall), "hold-stall");
  for (const Lost operators : {Lost::kDrives, Lost::kManual, Lost::kStop, Lost::kDisabled,
                               Lost::kTool, Lost::kFrame, Lost::kPayload, Lost::kNothing})
    EXPECT_EQ(reason(kActive, kHold, operators), "") << to_string(operators);
  EXPECT_EQ(reason(kShadow, kInit, Lost::kJoints), "");
}

/// Every metric that the example alerts ask for is one that plumb-rt has, with those labels.
TEST(ExampleAlerts, AskForMetricsThatThereAre) {
  std::ifstream in(fs::path(PLUMB_SOURCE_DIR) / "docs" / "examples" / "plumb-rt-alerts.yml");
  const std::string rules{std::istreambuf_iterator<char>(in), {}};
  RunFacts facts;
  facts.model_name = "an \"arm\"\\";
  facts.model_sha256 = "ab12";
  RunSnapshot snapshot;
  snapshot.session.state = SessionState::kFault;
  snapshot.session.cause = FaultCause::kPoseMismatch;
  snapshot.session.lost = Lost::kArmAway;
  const std::string metrics = metrics_text(snapshot, facts);
  const std::regex name("plumb_[a-z_]+");
  int asked = 0;
  for (std::sregex_iterator at(rules.begin(), rules.end(), name), end; at != end; ++at, ++asked)
    EXPECT_TRUE(std::regex_search(metrics, std::regex("\n" + at->str() + "[ {]"))) << at->str();
  EXPECT_GT(asked, 8);
  EXPECT_NE(metrics.find("\nplumb_fault{cause=\"pose-mismatch\"} 1\n"), std::string::npos);
  EXPECT_NE(metrics.find("\nplumb_fault{cause=\"other-robot\"} 0\n"), std::string::npos);
  EXPECT_NE(metrics.find("\nplumb_lost{input=\"arm-away\"} 1\n"), std::string::npos);
  EXPECT_NE(metrics.find("\nplumb_packing 0\n"), std::string::npos);
  facts.packing = "the check sums hold with the two bytes of each register swapped";
  EXPECT_NE(metrics_text(snapshot, facts).find("\nplumb_packing 1\n"), std::string::npos);
  EXPECT_NE(metrics.find("name=\"an \\\"arm\\\"\\\\\",file=\"\",sha256=\"ab12\""),
            std::string::npos)
      << metrics;
}

}  // namespace
}  // namespace plumb::drivers::rt
