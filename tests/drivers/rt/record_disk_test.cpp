// SPDX-License-Identifier: Apache-2.0
#include "rt/record_disk.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <limits>
#include <random>

#include "program/scratch_folder.hpp"
#include "tests/drivers/rt/folder_text.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;

class RecordDisks : public testing::Test {
 protected:
  void make(const std::string& name, const std::string& text = "x\n") const {
    std::ofstream(scratch.path() / name) << text;
  }
  std::vector<std::uint64_t> numbers() const {
    std::vector<std::uint64_t> out;
    for (const RecordPart& part : record_parts(file)) out.push_back(part.number);
    return out;
  }
  const ScratchFolder scratch{"plumb-parts-"};
  const fs::path file = scratch.path() / "record.log";
};

TEST_F(RecordDisks, PartsComeInTheOrderOfTheirNumbersWhateverTheOrderOnTheDisk) {
  std::vector<std::uint64_t> wanted{0, 1, 2, 9, 10, 11, 99, 100, 1'000'000};
  std::vector<std::uint64_t> made = wanted;
  std::shuffle(made.begin(), made.end(), std::mt19937(3));
  for (const std::uint64_t number : made)
    make(number == 0 ? "record.log" : "record.log." + std::to_string(number),
         std::string(number % 50, 'x'));
  EXPECT_EQ(numbers(), wanted);
  for (const RecordPart& part : record_parts(file)) {
    EXPECT_EQ(part.bytes, part.number % 50);
    EXPECT_EQ(fs::file_size(part.file), part.bytes) << "its name leads to it";
  }
}

TEST_F(RecordDisks, OnlyAFileOfItsOwnIsAPart) {
  make("elsewhere");
  fs::create_symlink("elsewhere", scratch.path() / "record.log.1");
  fs::create_directory(scratch.path() / "record.log.2");
  ASSERT_EQ(::mkfifo((scratch.path() / "record.log.3").c_str(), 0600), 0);
  for (const char* const name :
       {"record.log.04", "record.log.0", "record.log.+5", "record.log.6 ", "record.log.7.gz",
        "a-record.log", "record.log.-8", "record.log.99999999999999999999"})
    make(name);
  EXPECT_EQ(numbers(), std::vector<std::uint64_t>{});
}

/// A replay plays the files in the order of their numbers, so one that is written later has the
/// greater number; and no file of others is written to.
TEST_F(RecordDisks, TheNextPartFollowsAllThatAreThereAndIsFree) {
  EXPECT_EQ(next_part(file), file) << "the first one";
  std::mt19937 random(4);
  for (int i = 0; i < 30; ++i) {
    const fs::path next = next_part(file);
    EXPECT_FALSE(fs::exists(fs::symlink_status(next))) << next;
    const auto before = numbers();
    make(next.filename());
    ASSERT_EQ(numbers().size(), before.size() + 1) << next;
    EXPECT_EQ(record_parts(file).back().file, next);
    if (i % 4 == 3) fs::remove(record_parts(file).front().file);     // as the oldest go
    if (i % 7 == 6) fs::create_symlink("nowhere", next_part(file));  // a name that somebody took
  }
}

TEST_F(RecordDisks, ANumberBehindWhichNoneIsLeftIsNoPart) {
  make("record.log.1");
  make("record.log." + std::to_string(std::numeric_limits<std::uint64_t>::max()));
  EXPECT_EQ(next_part(file), scratch.path() / "record.log.2");
}

TEST_F(RecordDisks, ARecordNamedWithoutAFolderLiesInTheWorkingFolder) {
  const fs::path before = fs::current_path();
  fs::current_path(scratch.path());
  make("record.log");
  EXPECT_EQ(record_parts("record.log").size(), 1U);
  EXPECT_EQ(next_part("record.log"), "record.log.1");
  fs::current_path(before);
}

TEST_F(RecordDisks, AFullDiskIsNamedAndEveryOtherTroubleHasTheWordsOfTheSystem) {
  const auto asked_of = [&](std::uint64_t free) {
    return RecordDisk{.wall_s = [] { return std::int64_t{0}; },
                      .free_bytes =
                          [this, free](const fs::path& folder) {
                            EXPECT_EQ(folder, scratch.path());
                            return free;
                          }};
  };
  const std::uint64_t unknown = std::numeric_limits<std::uint64_t>::max();
  for (const int error : {ENOSPC, EDQUOT}) {
    const std::string said = why_not_written(file, error, "the record", asked_of(2'500'000));
    EXPECT_NE(said.find("2.5 MB are free"), std::string::npos) << said;
    EXPECT_NE(said.find("the record is no longer written"), std::string::npos) << said;
    EXPECT_EQ(said.find("quota") != std::string::npos, error == EDQUOT) << said;
    EXPECT_EQ(why_not_written(file, error, "the record", asked_of(unknown)).find("are free"),
              std::string::npos)
        << "what is not known is not said";
  }
  const std::string other = why_not_written(file, EACCES, "the record", asked_of(0));
  EXPECT_EQ(other, file.string() + ": Permission denied");
}

TEST_F(RecordDisks, TheRealDiskHasATimeAndAFolderThatIsNoneHasNoKnownSpace) {
  const RecordDisk disk = real_disk();
  EXPECT_GT(disk.wall_s(), 1'577'836'800) << "2020";
  EXPECT_LT(disk.free_bytes(scratch.path()), std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(disk.free_bytes(scratch.path() / "missing"), std::numeric_limits<std::uint64_t>::max());
}

}  // namespace
}  // namespace plumb::drivers::rt
