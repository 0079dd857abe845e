// SPDX-License-Identifier: Apache-2.0
// Installs and rollbacks where nothing runs, within the test; as a program they are seen in
// tests/drivers/install_test.cpp.
#include "rt/installing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "tests/drivers/rt/folder_text.hpp"
#include "tests/drivers/rt/placed.hpp"
#include "tests/drivers/rt/problem_of.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;

class Installing : public testing::Test {
 protected:
  Installing() {
    for (int i = 0; i < 4; ++i) {
      folders.push_back(std::make_unique<tests::Deployed>(
          tests::made_at("2026-11-25T1" + std::to_string(i) + ":00:00Z")));
      folders.back()->write_model("robot.plumb", tests::arm_shifted(1e-4 * i));
    }
  }
  InstallRequest request(const fs::path& from) const {
    InstallRequest out;
    out.change = {.place = placed.place, .etc = placed.etc};
    out.from = from;
    return out;
  }
  Changed install_one(int i, InstallRequest::Older older = InstallRequest::Older::kRefused,
                      int keep = 5) const {
    InstallRequest all = request(folder(i).folder);
    all.older = older;
    all.keep = keep;
    Outcome outcome;
    return install(all, outcome);
  }
  Changed back(const std::string& version = "") const {
    Outcome outcome;
    return roll_back({.place = placed.place, .etc = placed.etc}, version, outcome);
  }
  Problem refusal_of(const InstallRequest& one) const {
    return tests::problem_of([&] {
      Outcome outcome;
      std::ignore = install(one, outcome);
    });
  }
  const tests::Deployed& folder(int i) const { return *folders[static_cast<std::size_t>(i)]; }
  std::string id(int i) const { return tests::Placed::id_of(folder(i)); }

  tests::Placed placed;
  std::vector<std::unique_ptr<tests::Deployed>> folders;
};

/// The way that a person has in mind: what was installed last is on top, once; going back takes it
/// off. Nothing of it is kept anywhere but in the history of the place.
TEST_F(Installing, AnyOrderOfInstallsAndRollbacksLeadsWhereAPersonExpects) {
  tests::Random random(17);
  std::vector<int> way;
  for (int turn = 0; turn < 24; ++turn) {
    const bool goes_back = random.uniform(0.0, 1.0) < 0.45;
    if (goes_back && way.size() < 2) {
      const auto code = tests::problem_of([&] { std::ignore = back(); }).code;
      EXPECT_EQ(code, way.empty() ? "E-RT-PLACE" : "E-RT-ROLLBACK");
      continue;
    }
    if (goes_back) {
      std::ignore = back();
      way.pop_back();
    } else {
      const int next = static_cast<int>(random.uniform(0.0, 3.999));
      const bool same = !way.empty() && way.back() == next;
      EXPECT_EQ(install_one(next, InstallRequest::Older::kAllowed).nothing, same);
      std::erase(way, next);
      way.push_back(next);
    }
    ASSERT_EQ(placed.current(), id(way.back())) << turn;
    EXPECT_EQ(read_history(placed.place, placed.current()).lines.back().version, id(way.back()));
  }
}

TEST_F(Installing, WhatIsCurrentIsACopyOfWhatWasListedAndLoads) {
  std::ofstream(folder(0).folder / "events.jsonl") << "{}\n";
  const Changed changed = install_one(0);
  EXPECT_EQ(changed.line.version, id(0));
  EXPECT_EQ(changed.line.how, "stopped");
  EXPECT_EQ(changed.line.made, "2026-11-25T10:00:00Z");
  auto wanted = tests::folder_text(folder(0).folder);
  wanted.erase("events.jsonl");
  EXPECT_EQ(tests::folder_text(placed.place.version(id(0))), wanted);
  EXPECT_EQ(load_deployment(placed.place.folder).model.loaded->number(), changed.line.model);
}

TEST_F(Installing, ARefusedInstallLeavesThePlaceAsItWas) {
  install_one(1);
  const auto before = tests::folder_text(placed.place.folder);
  const tests::Deployed other, torn;
  format::Model model = tests::Deployed::arm();
  model.serial = "UR-2";
  other.write_model("robot.plumb", model);
  std::ofstream(torn.folder / "robot.plumb", std::ios::app) << "x";
  const fs::path other_place = placed.place.folder.parent_path() / "other";
  fs::create_directories(other_place / "versions");
  for (const auto& [from, code] :
       {std::pair{folder(0).folder, "E-RT-OLDER"}, std::pair{other.folder, "E-RT-SERIAL"},
        std::pair{torn.folder, "E-RT-SUMS"}, std::pair{other_place, "E-RT-PLACE"}}) {
    EXPECT_EQ(refusal_of(request(from)).code, code);
    EXPECT_EQ(tests::folder_text(placed.place.folder), before) << code;
  }
}

TEST_F(Installing, NothingIsInstalledInADeployFolderNorIsAPlaceMadeForNothing) {
  InstallRequest into = request(folder(1).folder);
  into.change.place = {folder(0).folder};
  const auto before = tests::folder_text(folder(0).folder);
  EXPECT_EQ(refusal_of(into).code, "E-RT-PLACE");
  EXPECT_EQ(tests::folder_text(folder(0).folder), before);
  std::ofstream(folder(2).folder / "rt.toml", std::ios::app) << "#\n";
  EXPECT_EQ(refusal_of(request(folder(2).folder)).code, "E-RT-SUMS");
  EXPECT_FALSE(fs::exists(placed.place.folder));
}

/// Who keeps but one version can still go back.
TEST_F(Installing, HoweverFewAreKeptTheCurrentOneAndTheOneBeforeItAre) {
  std::vector<std::string> removed;
  for (int i = 0; i < 4; ++i)
    for (const std::string& one : install_one(i, InstallRequest::Older::kRefused, 1).removed)
      removed.push_back(one);
  std::vector<std::string> wanted{id(2), id(3)};
  std::sort(wanted.begin(), wanted.end());
  EXPECT_EQ(placed.place.ids(), wanted);
  EXPECT_EQ(removed, (std::vector<std::string>{id(0), id(1)}));
  std::ignore = back();
  EXPECT_EQ(placed.current(), id(2));
}

TEST_F(Installing, AVersionThatIsNotThereOrIsNoLongerWholeIsNotGoneBackTo) {
  for (int i = 0; i < 3; ++i) install_one(i);
  fs::permissions(placed.place.version(id(0)), fs::perms::owner_all);
  fs::remove(placed.place.version(id(0)) / "robot.plumb");
  for (const std::string& version : {std::string(16, '0'), std::string("../..")})
    EXPECT_EQ(tests::problem_of([&] { std::ignore = back(version); }).code, "E-RT-ROLLBACK");
  EXPECT_NE(tests::problem_of([&] { std::ignore = back(id(0)); }).code, "");
  EXPECT_EQ(placed.current(), id(2));
  EXPECT_EQ(back(id(1)).line.what, "rollback");
  EXPECT_EQ(placed.current(), id(1));
}

/// A program that was killed between its line and the link has changed nothing; the next one says
/// so.
TEST_F(Installing, ALineThatDidNotTakeEffectIsRefusedByTheNextOne) {
  install_one(0);
  append_history(placed.place, history_line("install", id(1), id(0)));
  install_one(2);
  std::vector<std::string> versions;
  for (const HistoryLine& line : read_history(placed.place, id(2)).lines)
    versions.push_back(line.version);
  EXPECT_EQ(versions, (std::vector<std::string>{id(0), id(2)}));
  EXPECT_NE(tests::whole_text(placed.place.history()).find("\"refused\""), std::string::npos);
}

/// A link that somebody broke does not keep from mending it, and is said.
TEST_F(Installing, ABrokenCurrentIsMendedByTheNextInstall) {
  install_one(0);
  fs::remove(placed.place.link());
  fs::create_symlink("versions/none", placed.place.link());
  Outcome outcome;
  std::ignore = install(request(folder(1).folder), outcome);
  EXPECT_EQ(placed.current(), id(1));
  EXPECT_TRUE(std::any_of(outcome.remarks.begin(), outcome.remarks.end(), [](const Problem& one) {
    return one.code == "E-RT-PLACE" && one.severity == Severity::kWarning;
  }));
}

}  // namespace
}  // namespace plumb::drivers::rt
