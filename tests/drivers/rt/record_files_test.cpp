// SPDX-License-Identifier: Apache-2.0
#include "rt/record_files.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <sstream>

#include "program/scratch_folder.hpp"
#include "tests/drivers/rt/folder_text.hpp"
#include "tests/drivers/rt/problem_of.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;

constexpr char kLine[] = "(0000000001.000000) tick 000#0000000000000000\n";

class RecordFolder : public testing::Test {
 protected:
  void make(const std::string& name, const std::string& text = kLine) const {
    fs::create_directories((scratch.path() / name).parent_path());
    std::ofstream(scratch.path() / name) << text;
  }
  std::vector<std::string> names_in(const std::vector<std::string>& given,
                                    const fs::path& record = {}) const {
    std::vector<std::string> out;
    for (const fs::path& file : record_files(given, record))
      out.push_back(file.lexically_relative(scratch.path()).string());
    return out;
  }
  const ScratchFolder scratch{"plumb-records-"};
  const std::string here = scratch.path().string();
};

using Names = std::vector<std::string>;

TEST_F(RecordFolder, TheFilesOfOneRecordComeByTheirNumberAndSnapshotsByTheirTime) {
  for (const char* const name :
       {"b.log.10", "b.log", "b.log.9", "b.log.1", "a.log.2", "a.log",
        "2026-11-28T06-00-00Z-fault.log", "2026-11-27T23-00-00Z-fault.log"})
    make(name);
  EXPECT_EQ(names_in({here}),
            (Names{"2026-11-27T23-00-00Z-fault.log", "2026-11-28T06-00-00Z-fault.log", "a.log",
                   "a.log.2", "b.log", "b.log.1", "b.log.9", "b.log.10"}));
}

TEST_F(RecordFolder, WhatDoesNotBeginAsARecordIsNone) {
  make("record.log");
  make("events.jsonl", "{\"event\": \"start\"}\n");
  make("empty.log", "");
  make("torn.log", std::string(kLine).substr(0, 20));
  make("long.log", std::string(400, 'x') + "\n" + kLine);
  fs::create_directory(scratch.path() / "folder.log");
  ASSERT_EQ(::mkfifo((scratch.path() / "pipe.log").c_str(), 0600), 0) << "opening it would wait";
  EXPECT_EQ(names_in({here}), Names{"record.log"});
}

TEST_F(RecordFolder, AFolderThatPlumbRtRunsStandsForTheRecordOfItsSettingsAlone) {
  make("rt.toml", "");
  make("run/record.log.1");
  make("run/record.log");
  make("another.log");
  EXPECT_EQ(names_in({here}, scratch.path() / "run" / "record.log"),
            (Names{"run/record.log", "run/record.log.1"}));
}

TEST_F(RecordFolder, WhatIsGivenIsPlayedInTheOrderInWhichItIsGiven) {
  make("one/a.log");
  make("two/b.log");
  make("two/b.log.1");
  make("c.log");
  const std::string one = here + "/one", two = here + "/two", c = here + "/c.log";
  EXPECT_EQ(names_in({c, two, one}), (Names{"c.log", "two/b.log", "two/b.log.1", "one/a.log"}));
  EXPECT_EQ(names_in({one, c, two}), (Names{"one/a.log", "c.log", "two/b.log", "two/b.log.1"}));
}

TEST_F(RecordFolder, WhatIsMissingOrHasNoRecordIsRefusedByName) {
  make("settings/rt.toml", "");
  fs::create_directory(scratch.path() / "empty");
  for (const char* const name : {"settings", "empty"}) {
    const Problem problem = tests::problem_of([&] { std::ignore = names_in({here + "/" + name}); });
    EXPECT_EQ(problem.code, "E-RT-REPLAY") << name;
    EXPECT_NE(problem.message.find(name), std::string::npos) << problem.message;
    EXPECT_FALSE(problem.help.empty());
  }
  const Problem missing = tests::problem_of([&] { std::ignore = names_in({here + "/missing"}); });
  EXPECT_EQ(missing.code.substr(0, 6), "E-READ");
  EXPECT_NE(missing.message.find("missing"), std::string::npos);
}

/// A program that is killed leaves whole lines and a part of one.
TEST(EachWholeLine, WhereverTheTextIsCutWholeLinesAreTakenAndTheRestIsCounted) {
  const std::string text = "one\n\nthree\n" + std::string(500, 'x') + "\nfive\n";
  for (std::size_t cut = 0; cut <= text.size(); ++cut) {
    std::istringstream in(text.substr(0, cut));
    std::string taken;
    const std::size_t rest = each_whole_line(in, [&](const std::string& line) {
      taken += line + "\n";
      return true;
    });
    EXPECT_EQ(taken + text.substr(taken.size(), rest), text.substr(0, cut)) << cut;
    EXPECT_EQ(text.substr(taken.size(), rest).find('\n'), std::string::npos) << cut;
  }
}

TEST(EachWholeLine, StopsWhereItIsToldToAndHasNoRest) {
  std::istringstream in("one\ntwo\nthree");
  int taken = 0;
  EXPECT_EQ(each_whole_line(in, [&](const std::string&) { return ++taken < 2; }), 0U);
  EXPECT_EQ(taken, 2);
}

}  // namespace
}  // namespace plumb::drivers::rt
