// SPDX-License-Identifier: Apache-2.0
// The files of a record: how they follow each other, what is removed, and what a disk may do.
// Disk, clock and rights are planted.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "plumb/drivers/run_shared.hpp"
#include "program/scratch_folder.hpp"
#include "rt/record_line.hpp"
#include "rt/record_writer.hpp"
#include "rt/recorder.hpp"
#include "tests/drivers/child.hpp"
#include "tests/drivers/deployed.hpp"
#include "tests/drivers/rt/disk_limit.hpp"

namespace plumb::tests {
namespace {

using namespace drivers;
using namespace drivers::rt;
namespace fs = std::filesystem;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

class RecordFiles : public testing::Test {
 protected:
  RecordFiles() {
    settings.file = folder / "record.log";
    settings.max_total_mb = 1;  // so a file has 250 kB
  }

  RecordDisk disk() {
    return {.wall_s = [this] { return real_disk().wall_s() + later_s; },
            .free_bytes = [this](const fs::path&) { return free; }};
  }
  /// Lines of 100 bytes, with a beginning wherever one is wanted.
  void write(RecordWriter& to, int lines) {
    for (int i = 0; i < lines; ++i) {
      if (to.wants_beginning()) to.begin("begin " + std::to_string(++beginnings) + "\n", now_ns);
      to.add(std::string(99, 'x') + "\n");
      if (i % 100 == 0) to.tend(now_ns);
    }
    to.tend(now_ns);
  }
  void wait(RecordWriter& on, double seconds) {
    now_ns += static_cast<std::int64_t>(seconds * 1e9);
    on.tend(now_ns);
  }
  std::vector<std::string> names() const {
    std::vector<std::string> out;
    for (const auto& part : record_parts(settings.file)) out.push_back(part.file.filename());
    return out;
  }
  static std::string text(const fs::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  ScratchFolder scratch{"plumb-record-"};
  const fs::path& folder = scratch.path();
  RecordSettings settings;
  std::uint64_t free = 1'000'000'000'000;
  std::int64_t later_s = 0;  // of the planted clock
  std::int64_t now_ns = kSecond_ns;
  int beginnings = 0;
};

TEST_F(RecordFiles, FollowEachOtherWithinTheTotalAndTheOldestGo) {
  std::ofstream(settings.file) << std::string(700'000, 'a') << "\n";  // of a run before
  {
    RecordWriter record(settings, disk());
    write(record, 1'000);
    EXPECT_TRUE(fs::exists(settings.file));
    write(record, 19'000);  // 2 MB in all
    EXPECT_EQ(record.failure(), "");
  }
  EXPECT_FALSE(fs::exists(settings.file)) << "the oldest";
  const auto parts = record_parts(settings.file);
  std::uint64_t total = 0;
  for (const auto& part : parts) {
    total += part.bytes;
    EXPECT_LE(part.bytes, 250'000U) << part.file;
    const std::string lines = text(part.file);
    EXPECT_EQ(lines.rfind("begin ", 0), 0U) << "a replay can begin with each of them";
    EXPECT_EQ(lines.back(), '\n');
  }
  EXPECT_LE(total, 1'000'000U);
  EXPECT_GT(total, 500'000U);
  ASSERT_GE(parts.size(), 4U);
  for (std::size_t i = 1; i < parts.size(); ++i)
    EXPECT_EQ(parts[i].number, parts[i - 1].number + 1) << "none is missing between them";
}

TEST_F(RecordFiles, AFileOfAnotherNameIsNoneOfThem) {
  for (const char* end : {"", ".1", ".10", ".01", ".1x", ".x", "-1", ".-1"})
    std::ofstream(settings.file.string() + end) << "(0.000000) tick 000#\n";
  const auto parts = record_parts(settings.file);
  ASSERT_EQ(parts.size(), 3U);
  EXPECT_EQ(parts[2].number, 10U);
}

TEST_F(RecordFiles, WhatIsTooOldGoesAndThePresentFileStays) {
  settings.max_age_days = 30;
  for (const char* const old : {"record.log", "record.log.1"}) std::ofstream(folder / old) << "a\n";
  std::ofstream(folder / "record.log.old") << "not a part of it\n";
  RecordWriter record(settings, disk());
  write(record, 10);
  EXPECT_EQ(names().size(), 3U);
  later_s = 29 * 86'400;
  wait(record, 2.0);
  EXPECT_EQ(names().size(), 3U);
  later_s = 31 * 86'400;
  wait(record, 2.0);
  EXPECT_EQ(names(), std::vector<std::string>{"record.log.2"});
  EXPECT_TRUE(fs::exists(folder / "record.log.old"));
  write(record, 10);
  EXPECT_EQ(names(), std::vector<std::string>{"record.log"})
      << "a file of so many days is followed by another one, and removed";
}

TEST_F(RecordFiles, ADiskThatRunsFullMakesAPauseAndTheRecordGoesOnWhenThereIsSpace) {
  settings.free_space_floor_mb = 100;
  RecordWriter record(settings, disk());
  write(record, 100);
  free = 99'000'000;
  wait(record, 1.1);
  EXPECT_NE(record.failure().find("free_space_floor_mb = 100"), std::string::npos)
      << record.failure();
  EXPECT_FALSE(record.wants_beginning());
  const auto before = fs::file_size(settings.file);
  write(record, 100);
  EXPECT_EQ(fs::file_size(settings.file), before) << "nothing is written";
  free = 100'500'000;  // above the floor, but not so much that it would last
  for (int i = 0; i < 200; ++i) wait(record, 1.0), write(record, 1);
  EXPECT_NE(record.failure(), "");
  free = 200'000'000;
  for (int i = 0; i < 70; ++i) wait(record, 1.0);
  ASSERT_TRUE(record.wants_beginning());
  write(record, 100);
  EXPECT_EQ(record.failure(), "");
  EXPECT_EQ(names(), (std::vector<std::string>{"record.log", "record.log.1"}));
}

TEST_F(RecordFiles, ADiskThatIsFullIsCalledSoWithWhatIsFreeAndWhatToDo) {
  settings.free_space_floor_mb = 0;
  RecordWriter record(settings, disk());
  write(record, 100);
  free = 300'000;
  RecordWriter next(settings, disk());
  wait(next, 1.1);
  write(next, 1);
  const std::string why = next.failure();
  for (const char* const word :
       {"the disk is full, 0.3 MB are free", "the record is no longer written",
        "everything else goes on", "make room", "max_total_mb"})
    EXPECT_NE(why.find(word), std::string::npos) << word << ": " << why;
  EXPECT_EQ(why.find("free_space_floor_mb"), std::string::npos) << why;
  const std::string journal =
      why_not_written(folder / "events.jsonl", ENOSPC, "the journal", disk());
  EXPECT_EQ(journal, (folder / "events.jsonl").string() +
                         ": the disk is full, 0.3 MB are free: the journal is no longer written, "
                         "everything else goes on; make room on it");
  EXPECT_EQ(why_not_written("/a/b", EACCES, "the journal", disk()), "/a/b: Permission denied");
}

TEST_F(RecordFiles, OldFilesGoForTheFloorOnlyIfThatIsEnough) {
  settings.free_space_floor_mb = 100;
  std::ofstream(settings.file) << std::string(2'000'000, 'a') << "\n";
  settings.max_total_mb = 100;
  RecordWriter record(settings, disk());
  write(record, 10);
  free = 50'000'000;
  wait(record, 1.1);
  EXPECT_TRUE(fs::exists(settings.file)) << "2 MB would not help";
  EXPECT_NE(record.failure(), "");
  RecordDisk small = disk();  // of 102 MB, with nothing else on it
  small.free_bytes = [this](const fs::path&) {
    std::uint64_t used = 0;
    for (const auto& part : record_parts(settings.file)) used += part.bytes;
    return 102'000'000 - used;
  };
  RecordWriter other(settings, small);
  write(other, 10);
  wait(other, 1.1);
  EXPECT_FALSE(fs::exists(settings.file));
  EXPECT_EQ(other.failure(), "");
}

TEST_F(RecordFiles, AFolderThatIsGoneAndAFileThatIsRemovedMakeAPause) {
  fs::create_directory(folder / "records");
  settings.file = folder / "records" / "record.log";
  RecordWriter record(settings, disk());
  write(record, 10);
  fs::remove(settings.file);
  wait(record, 1.1);
  EXPECT_NE(record.failure().find("was removed"), std::string::npos) << record.failure();
  wait(record, 1.1);
  write(record, 10);
  EXPECT_EQ(record.failure(), "");
  fs::rename(folder / "records", folder / "elsewhere");
  write(record, 3'000);  // the next file is due
  EXPECT_NE(record.failure().find("No such file or directory"), std::string::npos)
      << record.failure();
  fs::rename(folder / "elsewhere", folder / "records");
  for (int i = 0; i < 70 && !record.wants_beginning(); ++i) wait(record, 1.0);
  write(record, 10);
  EXPECT_EQ(record.failure(), "");
  EXPECT_EQ(names().size(), 2U);
}

TEST_F(RecordFiles, ADiskThatIsFullAgainAtOnceIsTriedEverMoreRarely) {
  settings.file = "/dev/full/record.log";  // no folder: every attempt fails
  RecordWriter record(settings, disk());
  int attempts = 0;
  for (int i = 0; i < 3'600; ++i) {
    attempts += record.wants_beginning() ? 1 : 0;
    write(record, 1);
    wait(record, 1.0);
  }
  EXPECT_GT(attempts, 50) << "every minute";
  EXPECT_LT(attempts, 100);
}

/// The recorder without its thread, on a ring that a cycle of this test fills.
class RecorderRing : public RecordFiles {
 protected:
  RecorderRing() { settings.max_total_mb = 1000; }
  void tick() {
    shared->record.put({.what = RecordEntry::What::kTick, .tick = {.now_ns = ++ticks * 1'000'000}});
  }
  std::string interfaces() const {
    std::ifstream in(settings.file);
    std::string out, last;
    for (std::string line; std::getline(in, line);) {
      const auto read = parse_line(line);
      const std::string name = read ? read->interface : "?";
      if (name != last) out += (out.empty() ? "" : " ") + name;
      last = name;
    }
    return out;
  }
  std::unique_ptr<RunShared> shared = std::make_unique<RunShared>();
  std::int64_t ticks = 0;
};

TEST_F(RecorderRing, AGapStandsWhereEntriesAreMissingAndACopyOfTheSessionIsAskedFor) {
  Recorder recorder({.record = settings, .snapshots = {}, .answers = {}}, default_layout(6, 0.004),
                    "test", *shared, {}, disk());
  recorder.pass(now_ns);
  for (std::size_t i = 0; i < RecordRing::kEntries + 10; ++i) tick();
  EXPECT_FALSE(shared->copy.asked());
  recorder.pass(now_ns);
  tick();
  recorder.pass(now_ns);
  EXPECT_TRUE(shared->copy.asked());
  recorder.stop();
  EXPECT_EQ(interfaces(), "start tick gap tick");
  EXPECT_EQ(recorder.facts().lost, 10U);
}

TEST_F(RecorderRing, APauseAndItsEndAreSaidOnce) {
  settings.free_space_floor_mb = 100;
  Recorder recorder({.record = settings, .snapshots = {}, .answers = {}}, default_layout(6, 0.004),
                    "test", *shared, {}, disk());
  std::string said;
  const auto go = [&](int seconds) {
    for (int i = 0; i < 10 * seconds; ++i) {
      now_ns += kSecond_ns / 10;
      tick();
      if (shared->copy.asked()) {
        shared->record.put({.what = RecordEntry::What::kState, .tick = {}});
        shared->copy.given();
      }
      recorder.pass(now_ns);
      for (const auto& notice : recorder.take_notices()) said += std::string(notice.event) + " ";
    }
  };
  go(3);
  free = 0;
  go(20);
  EXPECT_NE(recorder.facts().failure, "");
  free = 1'000'000'000;
  go(100);
  EXPECT_EQ(recorder.facts().failure, "");
  EXPECT_EQ(said, "record-paused record-resumed ");
}

/// The corrected targets of a run without a robot are its result.
TEST_F(RecorderRing, AnswersThatTheDiskDoesNotTakeAreSaidOnce) {
  EXPECT_EQ(in_child([&] {
              limit_files(300);
              Recorder recorder({.record = {}, .snapshots = {}, .answers = folder / "answers.csv"},
                                default_layout(6, 0.004), "test", *shared, {});
              int said = 0;
              for (int i = 0; i < 50; ++i) {
                shared->record.put({.what = RecordEntry::What::kSent,
                                    .tick = {},
                                    .message = pose_message(MessageKind::kCorrected, {}, 1)});
                recorder.pass(now_ns);
                for (const RecordNotice& notice : recorder.take_notices())
                  said += std::string(notice.event) == "answers-stopped" &&
                                  notice.details.dump().find("answers.csv: File too large") !=
                                      std::string::npos
                              ? 1
                              : 100;
                if (i == 0 && said != 0) return 200;  // one answer fits
              }
              return said;
            }),
            1);
}

}  // namespace
}  // namespace plumb::tests
