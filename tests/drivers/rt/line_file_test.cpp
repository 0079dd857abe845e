// SPDX-License-Identifier: Apache-2.0
#include "rt/line_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <random>
#include <vector>

#include "program/scratch_folder.hpp"
#include "tests/drivers/child.hpp"
#include "tests/drivers/rt/disk_limit.hpp"
#include "tests/drivers/rt/folder_text.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;

class LineFiles : public testing::Test {
 protected:
  const ScratchFolder scratch{"plumb-lines-"};
  const fs::path file = scratch.path() / "lines";
};

/// Whole lines, one of them longer than what is collected before anything is written.
std::vector<std::string> some_lines(std::mt19937_64& random) {
  std::vector<std::string> out;
  for (int i = 0; i < 500; ++i) {
    const std::size_t length = i == 250 ? 100'000 : random() % 400;
    out.push_back(std::string(length, static_cast<char>('a' + i % 26)) + "\n");
  }
  return out;
}

/// The longest row of whole lines of a text that a disk of so many bytes holds.
std::string whole_lines_within(const std::string& text, std::size_t bytes) {
  const std::string taken = text.substr(0, bytes);
  const std::size_t end = taken.rfind('\n');
  return end == std::string::npos ? "" : taken.substr(0, end + 1);
}

TEST_F(LineFiles, AFullDiskTakesWhatItHoldsOfWholeLines) {
  std::mt19937_64 random(1);
  const auto lines = some_lines(random);
  std::string all;
  for (const std::string& line : lines) all += line;
  std::vector<std::size_t> limits{
      0, 1, lines[0].size() - 1, lines[0].size(), all.size() - 1, all.size()};
  for (int i = 0; i < 20; ++i) limits.push_back(random() % all.size());
  for (const std::size_t limit : limits) {
    SCOPED_TRACE(limit);
    const int error = tests::in_child([&] {
      tests::limit_files(limit);
      LineFile out(file);
      for (const std::string& line : lines) out.add(line);
      out.flush();
      return out.error();
    });
    EXPECT_EQ(error, limit < all.size() ? EFBIG : 0);
    const std::string whole = whole_lines_within(all, limit);
    EXPECT_EQ(tests::whole_text(file), whole);
    EXPECT_EQ(fs::exists(file), !whole.empty()) << "an empty file is removed";
    fs::remove(file);
  }
}

TEST_F(LineFiles, ItSaysHowManyBytesItWasGivenBeforeTheyAreWritten) {
  LineFile out(file);
  out.add("one\n");
  out.add("two\n");
  EXPECT_EQ(out.bytes(), 8U);
  out.sync();
  EXPECT_EQ(out.bytes(), 8U);
  EXPECT_EQ(tests::whole_text(file), "one\ntwo\n");
}

TEST_F(LineFiles, WhatIsThereAlreadyIsNeitherWrittenToNorRemoved) {
  std::ofstream(file) << "of another run\n";
  fs::create_symlink("elsewhere", scratch.path() / "link");
  for (const fs::path& name : {file, scratch.path() / "link"}) {
    LineFile out(name);
    EXPECT_EQ(out.error(), EEXIST);
    out.add("x\n");
    out.sync();
  }
  EXPECT_EQ(tests::folder_text(scratch.path()),
            (std::map<std::string, std::string>{{"lines", "holds of another run\n"},
                                                {"link", "to elsewhere"}}));
}

TEST_F(LineFiles, ItKnowsThatItWasRemovedAndNotThatItWasOnlyRenamed) {
  LineFile out(file);
  EXPECT_FALSE(out.removed());
  fs::rename(file, scratch.path() / "renamed");
  EXPECT_FALSE(out.removed());
  fs::remove(scratch.path() / "renamed");
  EXPECT_TRUE(out.removed());
}

TEST_F(LineFiles, WhatSomebodyPutInItsPlaceIsNotRemoved) {
  {
    LineFile out(file);
    fs::remove(file);
    std::ofstream(file) << "of somebody else\n";
  }
  EXPECT_EQ(tests::whole_text(file), "of somebody else\n");
}

}  // namespace
}  // namespace plumb::drivers::rt
