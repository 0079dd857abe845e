// SPDX-License-Identifier: Apache-2.0
#include "rt/version_store.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>

#include "program/scratch_folder.hpp"
#include "rt/synced_files.hpp"
#include "tests/drivers/child.hpp"
#include "tests/drivers/deployed.hpp"
#include "tests/drivers/rt/disk_limit.hpp"
#include "tests/drivers/rt/folder_text.hpp"
#include "tests/drivers/rt/problem_of.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;
using Make = VersionStore::Make;
using Added = VersionStore::Added;

class VersionStores : public testing::Test {
 protected:
  std::string sums() const { return folder.text("SHA256SUMS"); }
  std::string id() const { return version_of(sums()); }
  /// A version of this name, which holds nothing that matters.
  void plant(const std::string& name) const { fs::create_directories(place.version(name)); }
  static History history_of(const std::vector<std::string>& versions) {
    History out;
    for (const std::string& one : versions) {
      HistoryLine line;
      line.version = one;
      out.lines.push_back(line);
    }
    return out;
  }
  static std::string name(int i) {
    return std::string(15, '0') + std::string(1, "0123456789abcdef"[i]);
  }

  const ScratchFolder scratch{"plumb-store-"};
  const InstallPlace place{scratch.path() / "place"};
  const tests::Deployed folder;
};

TEST_F(VersionStores, APlaceInWhichNothingWasInstalledIsGoneAgain) {
  {
    const VersionStore store(place, Make::kYes);
    std::ignore = store.copy(folder.folder, sums());
    EXPECT_TRUE(place.ids().empty()) << "a copy is no version yet";
  }
  EXPECT_FALSE(fs::exists(place.folder));
  EXPECT_EQ(tests::problem_of([&] { VersionStore(place, Make::kNo); }).code, "E-RT-PLACE");
  EXPECT_FALSE(fs::exists(place.folder));
}

TEST_F(VersionStores, WhatIsAddedIsWhatWasListedAndStaysWhoeverAddsItAgain) {
  std::ofstream(folder.folder / "events.jsonl") << "{}\n";  // not listed
  for (int i = 0; i < 3; ++i) {
    const VersionStore store(place, Make::kYes);
    EXPECT_EQ(store.add(store.copy(folder.folder, sums()), id()),
              i == 0 ? Added::kNew : Added::kWasThere);
    auto wanted = tests::folder_text(folder.folder);
    wanted.erase("events.jsonl");
    EXPECT_EQ(tests::folder_text(place.version(id())), wanted);
  }
  EXPECT_EQ(place.ids(), std::vector<std::string>{id()});
  EXPECT_EQ(std::distance(fs::directory_iterator(place.versions()), {}), 1) << "nothing beside it";
}

/// A disk that lost a byte, or somebody who changed one, is mended by installing again.
TEST_F(VersionStores, AVersionThatIsNoLongerWhatItWasIsReplacedByTheCopy) {
  const VersionStore store(place, Make::kYes);
  store.add(store.copy(folder.folder, sums()), id());
  const auto whole = tests::folder_text(place.version(id()));
  ::chmod(place.version(id()).c_str(), 0755);
  for (const char* const changed : {"targets.csv", "SHA256SUMS", "extra"}) {
    fs::remove(place.version(id()) / changed);
    std::ofstream(place.version(id()) / changed) << "x\n";
    EXPECT_EQ(store.add(store.copy(folder.folder, sums()), id()), Added::kWasThere);
    EXPECT_EQ(tests::folder_text(place.version(id())), whole) << changed;
    ::chmod(place.version(id()).c_str(), 0755);
  }
}

TEST_F(VersionStores, WhatAKilledInstallLeftIsGoneForTheNextOne) {
  plant(name(1));
  plant(".new-1-2-3/below");
  plant(".old-4");
  ::chmod((place.versions() / ".new-1-2-3").c_str(), 0555);
  const VersionStore store(place, Make::kNo);
  EXPECT_EQ(tests::folder_text(place.versions()).size(), 1U);
  EXPECT_EQ(place.ids(), std::vector<std::string>{name(1)});
}

TEST_F(VersionStores, ACopyThatTheDiskDoesNotTakeLeavesThePlaceAsItWas) {
  plant(name(1));
  const auto before = tests::folder_text(place.folder);
  EXPECT_EQ(tests::in_child([&] {
              tests::limit_files(200);
              return tests::problem_of([&] {
                       const VersionStore store(place, Make::kYes);
                       std::ignore = store.copy(folder.folder, sums());
                     }).code == "E-WRITE"
                         ? 1
                         : 0;
            }),
            1);
  EXPECT_EQ(tests::folder_text(place.folder), before);
}

TEST_F(VersionStores, APlaceThatOthersMayWriteToIsRefused) {
  plant(name(1));
  for (const fs::path& open : {place.folder, place.versions()}) {
    ::chmod(open.c_str(), 0777);
    EXPECT_EQ(tests::problem_of([&] { VersionStore(place, Make::kNo); }).code, "E-RT-PLACE");
    ::chmod(open.c_str(), 0755);
  }
}

TEST_F(VersionStores, TheNewestStayWithAllThatAreNeededAndWhatRuns) {
  for (int i = 0; i < 8; ++i) plant(name(i));
  const VersionStore store(place, Make::kNo);
  const FolderLock runs(place.version(name(1)));
  std::vector<std::string> versions;
  for (int i = 0; i < 7; ++i) versions.push_back(name(i));  // the last one was never current
  versions.push_back(name(2));                              // and this one became so again
  const auto removed = store.keep_newest(3, history_of(versions), {name(0)});
  EXPECT_EQ(place.ids(), (std::vector<std::string>{name(0), name(1), name(2), name(5), name(6)}));
  EXPECT_EQ(removed.size(), 3U);
  EXPECT_TRUE(store.keep_newest(3, history_of(versions), {name(0)}).empty()) << "once is enough";
  EXPECT_TRUE(store.keep_newest(0, history_of({name(2)}), place.ids()).empty());
}

TEST_F(VersionStores, AVersionThatIsRemovedIsGoneAndOneThatIsNoneIsSaid) {
  plant(name(1));
  const VersionStore store(place, Make::kNo);
  EXPECT_TRUE(store.remove(name(1)));
  EXPECT_FALSE(store.remove(name(1)));
  EXPECT_TRUE(tests::folder_text(place.versions()).empty());
}

TEST_F(VersionStores, AVersionLoadsOnlyIfNothingElseStandsInIt) {
  const VersionStore store(place, Make::kYes);
  const fs::path copy = store.copy(folder.folder, sums());
  SigningRules rules;
  rules.unsigned_folders = SigningRules::Unsigned::kNoKeys;
  EXPECT_EQ(load_version(copy, rules).sums, sums());
  ::chmod(copy.c_str(), 0755);
  std::ofstream(copy / "events.jsonl") << "{}\n";
  EXPECT_EQ(tests::problem_of([&] { std::ignore = load_version(copy, rules); }).code,
            "E-RT-FOLDER");
}

}  // namespace
}  // namespace plumb::drivers::rt
