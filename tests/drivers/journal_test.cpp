// SPDX-License-Identifier: Apache-2.0
#include "rt/journal.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "program/scratch_folder.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;

class JournalFile : public testing::Test {
 protected:
  fs::path file() const { return folder_ / "events.jsonl"; }
  static void note_fault(Journal& journal, SessionMoment& moment) {
    moment.state = SessionState::kFault;
    moment.cause = FaultCause::kPoseMismatch;
    journal.note_change(moment);
  }
  ScratchFolder scratch{"plumb-journal-"};
  const fs::path& folder_ = scratch.path();
};

TEST_F(JournalFile, AFaultIsWrittenWithItsCauseAndTheModel) {
  Journal journal(file(), Journal::Echo::kNone);
  SessionMoment moment{.time_ns = 5'000'000'000, .state = SessionState::kActive, .model = 7};
  journal.note_change(moment);
  moment.state = SessionState::kFault;
  moment.cause = FaultCause::kForeignSender;
  moment.lost = Lost::kDrives | Lost::kTarget;
  journal.note_change(moment);
  journal.note_change(moment);  // nothing new
  std::string course;
  for (const Json& event : read_events(file(), 100).events) course += event.dump() + "\n";
  EXPECT_NE(course.find("\"cause\":\"foreign-sender\""), std::string::npos) << course;
  EXPECT_NE(course.find("\"fingerprint\":7"), std::string::npos) << course;
  EXPECT_NE(course.find("\"monotonic_s\":5.0"), std::string::npos) << course;
  EXPECT_NE(course.find("target"), std::string::npos) << course;
  EXPECT_EQ(std::count(course.begin(), course.end(), '\n'), 5) << course;
}

TEST_F(JournalFile, StaysWithinItsSizeAndKeepsTheNewest) {
  Journal journal(file(), Journal::Echo::kNone);
  SessionMoment moment;
  for (int k = 0; k < 20'000; ++k) {
    moment.time_ns = k * 3'000'000'000LL;  // as many as are written
    moment.model = static_cast<std::uint32_t>(k + 1);
    journal.note_change(moment);
  }
  EXPECT_LE(fs::file_size(file()), Journal::kMostBytes);
  EXPECT_LE(fs::file_size(file().string() + ".1"), Journal::kMostBytes);
  EXPECT_EQ(read_events(file(), 1).events.front()["fingerprint"], 20'000);
}

TEST_F(JournalFile, AFloodIsCountedAndSaidOnceAMinute) {
  Journal journal(file(), Journal::Echo::kNone);
  SessionMoment moment;
  constexpr int kTimes = 10'000;  // for five minutes
  for (int k = 0; k < kTimes; ++k) {
    moment.time_ns = 1'000'000'000LL + k * 30'000'000LL;
    moment.link = k % 2 == 0 ? LinkState::kDegraded : LinkState::kUp;
    journal.note_change(moment);
  }
  journal.tend(moment.time_ns + 61'000'000'000);
  std::map<std::string, int> events;
  int written = 0, left_out = 0;
  for (const Json& event : read_events(file(), 100'000).events) {
    ++events[event["event"]];
    written += event["event"] == "link" ? 1 : 0;
    if (event["event"] != "left-out") continue;
    left_out += event["events"].get<int>();
    EXPECT_EQ(event["of"], "link");
  }
  EXPECT_EQ(events["left-out"], 5);
  EXPECT_EQ(written, 5 * Journal::kMostPerMinute);
  EXPECT_EQ(written + left_out, kTimes);
}

TEST_F(JournalFile, WhatLedToAFaultIsNotPushedOutByWhatFollows) {
  Journal journal(file(), Journal::Echo::kNone);
  SessionMoment moment{.time_ns = 1'000'000'000, .model = 4711};
  journal.note_change(moment);
  note_fault(journal, moment);
  for (int k = 0; k < 20'000; ++k) {  // a week of it
    moment.time_ns += 30'000'000'000;
    moment.model = static_cast<std::uint32_t>(k + 1);
    journal.note_change(moment);
  }
  const auto events = read_events(file(), 1'000'000).events;
  EXPECT_EQ(events.front()["fingerprint"], 4711);
  const auto fault =
      std::ranges::find(events, Json("fault"), [](const Json& e) { return e["event"]; });
  ASSERT_NE(fault, events.end());
  EXPECT_EQ((*fault)["cause"], "pose-mismatch");
  EXPECT_EQ(events.back()["fingerprint"], 20'000);
}

TEST_F(JournalFile, TheEventsOfAFaultAreNotShownTwice) {
  Journal journal(file(), Journal::Echo::kNone);
  SessionMoment moment{.time_ns = 1'000'000'000, .model = 1};
  journal.note_change(moment);
  note_fault(journal, moment);
  const auto lines = [](const fs::path& of) {
    std::ifstream in(of);
    return std::count(std::istreambuf_iterator<char>(in), {}, '\n');
  };
  EXPECT_TRUE(fs::exists(file().string() + ".fault"));
  EXPECT_EQ(static_cast<std::ptrdiff_t>(read_events(file(), 100).events.size()), lines(file()));
}

TEST_F(JournalFile, AFaultInAFloodIsNotLeftOut) {
  Journal journal(file(), Journal::Echo::kNone);
  SessionMoment moment{.time_ns = 1'000'000'000};
  for (int k = 0; k < 1'000; ++k) {
    ++moment.time_ns;
    moment.model = static_cast<std::uint32_t>(k + 1);
    journal.note_change(moment);
  }
  moment.state = SessionState::kFault;
  moment.cause = FaultCause::kOtherRobot;
  journal.note_change(moment);
  const auto events = read_events(file(), 2).events;
  EXPECT_EQ(events[0]["to"], "fault");
  EXPECT_EQ(events[1]["cause"], "other-robot");
}

TEST_F(JournalFile, AKilledWriterCostsOnlyTheLineThatItDidNotFinish) {
  const auto note = [&](int cycles) {
    Journal(file(), Journal::Echo::kNone).note("end", {{"cycles", cycles}});
  };
  for (const int rest : {0, 1, 40}) {
    fs::remove(file());
    note(1);
    const auto line = fs::file_size(file());
    note(2);
    fs::resize_file(file(), line + static_cast<std::uintmax_t>(rest));  // the second is cut off
    note(3);
    const auto read = read_events(file(), 10);
    ASSERT_EQ(read.events.size(), 2U) << rest;
    EXPECT_EQ(read.events[0]["cycles"], 1);
    EXPECT_EQ(read.events[1]["cycles"], 3);
    EXPECT_EQ(read.damaged, rest == 0 ? 0U : 1U);
  }
}

TEST_F(JournalFile, OfAHugeFileOnlyTheEndIsReadAndOfNoneNothing) {
  EXPECT_TRUE(read_events(file(), 10).events.empty());
  std::ofstream(file()) << "{\"event\": \"start\", \"time\": 5}\n[1]\n\n{\"event\": 3}\n";
  EXPECT_EQ(read_events(file(), 10).damaged, 2U);
  EXPECT_EQ(event_text(read_events(file(), 10).events.front()), "  start");
  fs::resize_file(file(), std::uintmax_t{1} << 36);  // 64 GiB, of holes
  std::ofstream(file(), std::ios::app) << "\n{\"event\": \"end\"}\n";
  const auto read = read_events(file(), 10);
  ASSERT_EQ(read.events.size(), 1U);
  EXPECT_EQ(read.events.front()["event"], "end");
}

TEST_F(JournalFile, ADeviceOrALostFolderEndsOnlyTheFile) {
  Journal device("/dev/full", Journal::Echo::kNone);
  device.note("start", Json::object());
  EXPECT_NE(device.failure(), "");
  Journal nowhere(folder_ / "gone" / "events.jsonl", Journal::Echo::kNone);
  nowhere.note("start", Json::object());
  EXPECT_NE(nowhere.failure(), "");
}

}  // namespace
}  // namespace plumb::drivers::rt
