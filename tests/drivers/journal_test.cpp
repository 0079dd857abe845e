// SPDX-License-Identifier: Apache-2.0
#include "rt/journal.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>

#include <filesystem>
#include <fstream>

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;

class JournalFile : public testing::Test {
 protected:
  JournalFile() {
    std::string name = (fs::temp_directory_path() / "plumb-journal-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~JournalFile() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  fs::path file() const { return folder_ / "events.jsonl"; }
  fs::path folder_;
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
  for (const Json& event : read_events(file(), 100)) course += event.dump() + "\n";
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
    moment.time_ns = k * 1'000'000'000LL;
    moment.model = static_cast<std::uint32_t>(k + 1);
    journal.note_change(moment);
  }
  EXPECT_LE(fs::file_size(file()), Journal::kMostBytes);
  EXPECT_LE(fs::file_size(file().string() + ".1"), Journal::kMostBytes);
  EXPECT_EQ(read_events(file(), 1).front()["fingerprint"], 20'000);
}

TEST_F(JournalFile, AFloodIsCounted) {
  Journal journal(file(), Journal::Echo::kNone);
  SessionMoment moment;
  for (int k = 0; k < 1'000; ++k) {
    moment.time_ns = 1'000'000'000LL + k;
    moment.model = static_cast<std::uint32_t>(k + 1);
    journal.note_change(moment);
  }
  moment.time_ns += 2'000'000'000;
  moment.model = 5'000;
  journal.note_change(moment);
  const auto events = read_events(file(), 1'000);
  EXPECT_EQ(events.size(), static_cast<std::size_t>(Journal::kMostPerSecond) + 2);
  EXPECT_EQ(events[events.size() - 2]["event"], "left-out");
  EXPECT_EQ(events[events.size() - 2]["events"], 1'000 - Journal::kMostPerSecond);
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
