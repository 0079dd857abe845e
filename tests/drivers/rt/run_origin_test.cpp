// SPDX-License-Identifier: Apache-2.0
#include "rt/run_origin.hpp"

#include <gtest/gtest.h>

#include "program/scratch_folder.hpp"
#include "rt/install_history.hpp"
#include "tests/drivers/deployed.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;

const std::string kVersionA(16, 'a'), kVersionB(16, 'b');

/// A place with two versions that hold nothing, the first of which is current.
class RunOrigins : public testing::Test {
 protected:
  RunOrigins() {
    for (const std::string& one : {kVersionA, kVersionB})
      fs::create_directories(place.version(one));
    make_current(kVersionA);
  }
  void make_current(const std::string& id) const { CurrentLink::prepare(place, id).commit(); }
  void note(const std::string& version, const std::string& previous, const std::string& made,
            const std::string& by, const std::string& host) const {
    HistoryLine line = history_line("install", version, previous);
    line.time = "at " + made;
    line.made = made;
    line.by = by;
    line.host = host;
    append_history(place, line);
  }
  Deployment running(const std::string& version) const {
    Deployment out;
    out.folder = place.folder;
    out.model.version = version;
    out.model.origin = {.key = "cell", .key_id = "0123", .note = ""};
    out.config.made = "2025-01-01T00:00:00Z";
    return out;
  }
  const ScratchFolder scratch{"plumb-origin-"};
  const InstallPlace place{scratch.path() / "place"};
};

TEST_F(RunOrigins, ADeployFolderComesFromNoPlaceAndNeedsNoRestart) {
  const tests::Deployed folder(tests::Deployed::csv("[model]\nmade = \"2026-11-25T10:00:00Z\"\n"));
  const RunOrigin origin = find_run_origin(load_deployment(folder.folder));
  EXPECT_EQ(origin.place, "");
  EXPECT_EQ(origin.version, "");
  EXPECT_EQ(origin.installed_by, "");
  EXPECT_EQ(origin.made, "2026-11-25T10:00:00Z");
  EXPECT_FALSE(origin.restart_needed());
}

TEST_F(RunOrigins, AVersionWasInstalledByWhoeverMadeItCurrentLast) {
  note(kVersionA, "", "2026-11-01T00:00:00Z", "anna", "cell-pc");
  note(kVersionB, kVersionA, "2026-11-02T00:00:00Z", "ben", "cell-pc");
  note(kVersionA, kVersionB, "2026-11-03T00:00:00Z", "carl", "");
  const RunOrigin origin = find_run_origin(running(kVersionA));
  EXPECT_EQ(origin.place, fs::absolute(place.folder).string());
  EXPECT_EQ(origin.installed_by, "carl");
  EXPECT_EQ(origin.installed_at, "at 2026-11-03T00:00:00Z");
  EXPECT_EQ(origin.made, "2026-11-03T00:00:00Z");
  EXPECT_EQ(origin.key, "cell");
  EXPECT_EQ(origin.key_id, "0123");
  EXPECT_FALSE(origin.restart_needed());
}

TEST_F(RunOrigins, WhatRunsIsSaidAlthoughAnotherVersionWasInstalledMeanwhile) {
  note(kVersionA, "", "2026-11-01T00:00:00Z", "anna", "cell-pc");
  note(kVersionB, kVersionA, "2026-11-02T00:00:00Z", "ben", "cell-pc");
  make_current(kVersionB);
  const RunOrigin origin = find_run_origin(running(kVersionA));
  EXPECT_EQ(origin.version, kVersionA);
  EXPECT_EQ(origin.current, kVersionB);
  EXPECT_EQ(origin.installed_by, "anna on cell-pc");
  EXPECT_TRUE(origin.restart_needed());
}

/// An install writes its line, asks for the swap, and renames `current` only then.
TEST_F(RunOrigins, AnInstallThatIsUnderWayHasItsLineAlready) {
  note(kVersionA, "", "2026-11-01T00:00:00Z", "anna", "cell-pc");
  note(kVersionB, kVersionA, "2026-11-02T00:00:00Z", "ben", "cell-pc");
  EXPECT_EQ(find_run_origin(running(kVersionB)).installed_by, "ben on cell-pc");
}

TEST_F(RunOrigins, APlaceWhoseHistoryWasLostSaysWhenItsFolderWasMade) {
  const RunOrigin origin = find_run_origin(running(kVersionA));
  EXPECT_EQ(origin.made, "2025-01-01T00:00:00Z");
  EXPECT_EQ(origin.installed_by, "");
}

RunOrigin all_known() {
  return {.place = "/cell",
          .version = kVersionA,
          .current = kVersionB,
          .made = "made-then",
          .installed_at = "installed-then",
          .installed_by = "anna on cell-pc",
          .key = "cell-key",
          .key_id = "0123456789",
          .note = ""};
}

/// Which of its texts are known does not matter: what is known is said, and nothing is said of the
/// rest. Only of a place it is known who installed what runs.
TEST(RunOriginText, SaysWhatIsKnownAndNothingElse) {
  for (unsigned known = 0; known < 32; ++known) {
    if ((known & 5) == 4) continue;
    RunOrigin origin = all_known();
    origin.current = origin.version;
    if ((known & 1) == 0) origin.place.clear();
    if ((known & 2) == 0) origin.made.clear();
    if ((known & 4) == 0) origin.installed_by.clear();
    if ((known & 8) == 0) origin.key.clear();
    if ((known & 16) != 0) origin.note = "unsigned: for a reason";
    const std::string text = run_origin_text(to_json(origin));
    const auto says = [&](const std::string& words) {
      return text.find(words) != std::string::npos;
    };
    EXPECT_EQ(says("version " + kVersionA), (known & 1) != 0) << text;
    EXPECT_EQ(says("made-then"), (known & 2) != 0) << text;
    EXPECT_EQ(says("by anna on cell-pc"), (known & 4) != 0) << text;
    EXPECT_EQ(says("signed by cell-key"), (known & 24) == 8) << text;
    EXPECT_EQ(says("for a reason"), (known & 16) != 0) << text;
    EXPECT_FALSE(says(", ,")) << text;
    EXPECT_EQ(text.empty(), known == 0) << text;
    EXPECT_FALSE(says("origin      ,")) << text;
  }
}

TEST(RunOriginText, ARestartIsSaidOfAPlaceWhoseCurrentVersionDoesNotRun) {
  RunOrigin origin = all_known();
  const std::string words = "version " + kVersionB + " is installed but not running";
  EXPECT_NE(run_origin_text(to_json(origin)).find(words), std::string::npos);
  origin.version = kVersionB;
  EXPECT_EQ(run_origin_text(to_json(origin)).find("RESTART"), std::string::npos);
  origin.version.clear();  // a model was swapped in that is no version
  EXPECT_NE(run_origin_text(to_json(origin)).find(words), std::string::npos);
  origin.place.clear();
  EXPECT_EQ(run_origin_text(to_json(origin)).find("RESTART"), std::string::npos);
}

TEST(RunOriginText, AnEventHoldsEveryTextThatIsKnownButTheVersionOfTheNextStart) {
  const RunOrigin origin = all_known();
  EXPECT_EQ(event_details(origin), (Json{{"place", "/cell"},
                                         {"version", kVersionA},
                                         {"made", "made-then"},
                                         {"installed_at", "installed-then"},
                                         {"installed_by", "anna on cell-pc"},
                                         {"signed_by", "cell-key"},
                                         {"key_id", "0123456789"}}));
  EXPECT_EQ(event_details({}), Json::object());
}

}  // namespace
}  // namespace plumb::drivers::rt
