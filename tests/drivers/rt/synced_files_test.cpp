// SPDX-License-Identifier: Apache-2.0
#include "rt/synced_files.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <functional>

#include "program/scratch_folder.hpp"
#include "tests/drivers/child.hpp"
#include "tests/drivers/rt/disk_limit.hpp"
#include "tests/drivers/rt/folder_text.hpp"
#include "tests/drivers/rt/problem_of.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;

unsigned mode_of(const fs::path& file) {
  struct stat found {};
  return ::lstat(file.c_str(), &found) == 0 ? found.st_mode & 07777U : 0U;
}

class SyncedFiles : public testing::Test {
 protected:
  SyncedFiles() {
    fs::create_directories(from / "below" / "deep");
    for (const std::string& name : names) std::ofstream(from / name) << "of " << name << "\n";
  }
  const ScratchFolder scratch{"plumb-synced-"};
  const fs::path from = scratch.path() / "from", to = scratch.path() / "to",
                 file = scratch.path() / "lines";
  const std::vector<std::string> names{"a", "below/b", "below/deep/c", "z"};
};

TEST_F(SyncedFiles, WhatIsAppendedIsALineOfItsOwnBehindWhatWasThere) {
  for (const std::string before : {"", "one\n", "one\ntorn", "\n"}) {
    std::ofstream(file) << before;
    append_synced(file, "new");
    append_synced(file, "newer");
    const std::string end = before.empty() || before.back() == '\n' ? "" : "\n";
    EXPECT_EQ(tests::whole_text(file), before + end + "new\nnewer\n");
    fs::remove(file);
  }
}

TEST_F(SyncedFiles, ALineThatADiskDoesNotTakeWholeLeavesTheFileAsItWas) {
  for (const std::string before : {"one\n", "one\ntorn"})
    for (std::size_t room = 0; room < 8; ++room) {
      std::ofstream(file) << before;
      const int exit = tests::in_child([&] {
        tests::limit_files(before.size() + room);
        return tests::problem_of([&] { append_synced(file, "12345678"); }).code == "E-WRITE" ? 1
                                                                                             : 0;
      });
      EXPECT_EQ(exit, 1);
      EXPECT_EQ(tests::whole_text(file), before) << room;
    }
}

TEST_F(SyncedFiles, ALinkOrAPipeInThePlaceOfAFileIsNotWrittenTo) {
  std::ofstream(scratch.path() / "shadow") << "root\n";
  fs::create_symlink("shadow", scratch.path() / "link");
  fs::create_symlink("nowhere", scratch.path() / "dangling");
  ASSERT_EQ(::mkfifo((scratch.path() / "pipe").c_str(), 0600), 0) << "opening it would wait";
  const auto before = tests::folder_text(scratch.path());
  for (const char* const name : {"link", "dangling", "pipe", "from", "missing/x"}) {
    const Problem found = tests::problem_of([&] { append_synced(scratch.path() / name, "x"); });
    EXPECT_EQ(found.code, "E-WRITE") << name;
    EXPECT_NE(found.message.find(name), std::string::npos) << found.message;
  }
  EXPECT_EQ(tests::folder_text(scratch.path()), before);
}

TEST_F(SyncedFiles, ACopyIsTheSameAndNobodyMayWriteToIt) {
  std::vector<std::string> order = names;
  do {
    copy_synced(from, order, to);
    EXPECT_EQ(tests::folder_text(to), tests::folder_text(from));
    for (const std::string& name : order) EXPECT_EQ(mode_of(to / name), 0444U) << name;
    for (const fs::path& folder : {to, to / "below", to / "below" / "deep"})
      EXPECT_EQ(mode_of(folder), 0555U) << folder;
    EXPECT_TRUE(remove_folder(to));
  } while (std::next_permutation(order.begin(), order.end()));
}

/// Whichever file it is, and however many were copied before.
TEST_F(SyncedFiles, WhatMayNotBeCopiedIsNamedAndNothingOfTheCopyIsLeft) {
  struct Plant {
    const char* code;
    std::function<void(const fs::path&)> make;
  };
  std::ofstream(scratch.path() / "other") << "x";
  const Plant plants[] = {
      {"E-READ", [](const fs::path&) {}},
      {"E-RT-FOLDER",
       [&](const fs::path& at) { fs::create_symlink(scratch.path() / "other", at); }},
      {"E-RT-FOLDER",
       [&](const fs::path& at) { fs::create_hard_link(scratch.path() / "other", at); }},
      {"E-RT-FOLDER", [](const fs::path& at) { ::mkfifo(at.c_str(), 0600); }},
      {"E-RT-FOLDER", [](const fs::path& at) { fs::create_directory(at); }}};
  for (const std::string& name : names)
    for (const Plant& plant : plants) {
      fs::remove_all(from / name);
      plant.make(from / name);
      const Problem found = tests::problem_of([&] { copy_synced(from, names, to); });
      EXPECT_EQ(found.code, plant.code) << name;
      EXPECT_NE(found.message.find(name), std::string::npos) << found.message;
      EXPECT_FALSE(fs::exists(fs::symlink_status(to)));
      fs::remove_all(from / name);
      std::ofstream(from / name) << "of " << name << "\n";
    }
}

TEST_F(SyncedFiles, ACopyThatTheDiskDoesNotTakeLeavesNothing) {
  std::ofstream(from / "z") << std::string(5000, 'z');
  EXPECT_EQ(tests::in_child([&] {
              tests::limit_files(1000);
              return tests::problem_of([&] { copy_synced(from, names, to); }).code == "E-WRITE" ? 1
                                                                                                : 0;
            }),
            1);
  EXPECT_FALSE(fs::exists(to));
}

TEST_F(SyncedFiles, AFolderThatIsThereIsNeitherCopiedIntoNorRemoved) {
  fs::create_directory(to);
  std::ofstream(to / "mine") << "x";
  const auto before = tests::folder_text(to);
  EXPECT_EQ(tests::problem_of([&] { copy_synced(from, names, to); }).code, "E-WRITE");
  EXPECT_EQ(tests::folder_text(to), before);
}

TEST_F(SyncedFiles, RemovingAFolderFollowsNoLink) {
  fs::create_directory(scratch.path() / "kept");
  std::ofstream(scratch.path() / "kept" / "x") << "x";
  ::chmod((scratch.path() / "kept").c_str(), 0555);
  fs::create_directory(to);
  fs::create_directory_symlink(scratch.path() / "kept", to / "link");
  EXPECT_TRUE(remove_folder(to));
  EXPECT_FALSE(fs::exists(to));
  fs::create_directory_symlink(scratch.path() / "kept", to);
  EXPECT_TRUE(remove_folder(to)) << "the link itself";
  EXPECT_FALSE(fs::exists(fs::symlink_status(to)));
  EXPECT_TRUE(fs::exists(scratch.path() / "kept" / "x"));
  EXPECT_EQ(mode_of(scratch.path() / "kept"), 0555U);
  ::chmod((scratch.path() / "kept").c_str(), 0755);
}

TEST_F(SyncedFiles, AFolderThatIsNoneCannotBeSynced) {
  sync_folder(scratch.path());
  for (const char* const name : {"missing", "from/a"})
    EXPECT_EQ(tests::problem_of([&] { sync_folder(scratch.path() / name); }).code, "E-WRITE");
}

}  // namespace
}  // namespace plumb::drivers::rt
