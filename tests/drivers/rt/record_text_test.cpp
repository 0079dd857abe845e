// SPDX-License-Identifier: Apache-2.0
#include "rt/record_text.hpp"

#include <gtest/gtest.h>

#include <sstream>
#include <vector>

#include "plumb/drivers/bus_content.hpp"
#include "rt/record_line.hpp"

namespace plumb::drivers::rt {
namespace {

using What = RecordEntry::What;

std::vector<RecordLine> lines_of(const std::string& text) {
  EXPECT_TRUE(text.empty() || text.back() == '\n') << text;
  std::vector<RecordLine> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    const auto read = parse_line(line);
    EXPECT_TRUE(read.has_value()) << line;
    if (read) out.push_back(*read);
  }
  return out;
}

RecordEntry entry_of(What what, MessageKind kind, std::uint16_t counter) {
  RecordEntry out{.what = what, .tick = {}};
  Transformd pose;
  pose.p = Vector3(0.001 * counter, 0.2, 0.3);
  out.message = pose_message(kind, pose, counter);
  out.message.time_ns = 1'000'000LL * counter;
  return out;
}

/// Both formats, and a message that is one frame or several.
std::vector<BusLayout> layouts() {
  std::vector<BusLayout> out{default_layout(6, 0.004), default_layout(6, 0.004)};
  out[1].can_format = CanFrame::Format::kFd;
  return out;
}

TEST(RecordText, WhatPassedTheBusIsReadBackFromItsFrames) {
  for (const BusLayout& layout : layouts()) {
    RecordText text(layout, "can7");
    CanCodec codec(layout);
    for (const auto& [what, kind] : {std::pair{What::kReceived, MessageKind::kTarget},
                                     std::pair{What::kSent, MessageKind::kCorrected},
                                     std::pair{What::kNotSent, MessageKind::kCorrected}})
      for (std::uint16_t counter = 1; counter < 20; ++counter) {
        const RecordEntry entry = entry_of(what, kind, counter);
        const auto lines = lines_of(text.entry(entry, {}));
        ASSERT_EQ(lines.size(), can_frames(layout, *layout.find(kind)));
        BusMessage read;
        Heard heard = Heard::kNotOurs;
        for (const RecordLine& line : lines) {
          EXPECT_EQ(line.interface, what == What::kNotSent ? kUnsentName : "can7");
          EXPECT_EQ(line.frame.time_ns, entry.message.time_ns);
          heard = codec.hear(line.frame, read);
        }
        if (what == What::kNotSent) continue;  // the codec has heard this counter before
        ASSERT_EQ(heard, Heard::kComplete);
        EXPECT_EQ(read.kind, kind);
        EXPECT_NEAR(read.values[0], 0.001 * counter, 1e-6);
      }
  }
}

TEST(RecordText, AMessageThatTheLayoutDoesNotHaveIsNoLine) {
  BusLayout layout = default_layout(6, 0.004);
  std::erase_if(layout.messages, [](const auto& m) { return m.kind == MessageKind::kTarget; });
  RecordText text(layout, "can0");
  EXPECT_EQ(text.entry(entry_of(What::kReceived, MessageKind::kTarget, 1), {}), "");
}

TEST(RecordText, AStepSaysWhatItWasToldAndByWhichModel) {
  RecordText text(default_layout(6, 0.004), "can0");
  RecordEntry entry{.tick = {.now_ns = 77'000'000, .foreign_senders = 3}, .model = 0x123456};
  entry.tick.run = SessionTick::Run::kStop;
  const auto lines = lines_of(text.entry(entry, {}));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].interface, kTickName);
  const RecordedTick read = tick_in(lines[0].frame);
  EXPECT_EQ(read.told.now_ns, 77'000'000);
  EXPECT_EQ(read.told.foreign_senders, 3U);
  EXPECT_EQ(read.told.run, SessionTick::Run::kStop);
  EXPECT_EQ(read.model, 0x123456U);
}

TEST(RecordText, ARunBeginsWithWhatTheRunsBeforeLeft) {
  RecordText text(default_layout(6, 0.004), "can0");
  SessionStart start;
  start.fault = FaultCause::kPoseMismatch;
  start.acknowledgement = SessionStart::Acknowledgement::kNeeded;
  const auto lines = lines_of(text.start(start));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].interface, kStartName);
  EXPECT_EQ(start_in(lines[0].frame).fault, start.fault);
  EXPECT_EQ(start_in(lines[0].frame).acknowledgement, start.acknowledgement);
}

/// The number is in the bytes of the frame, the lowest first, for whoever reads the file by hand.
TEST(RecordText, AGapSaysHowManyAreMissingAndWhenItBegan) {
  RecordText text(default_layout(6, 0.004), "can0");
  std::ignore = text.entry({.tick = {.now_ns = 5'000'000}}, {});
  for (const std::uint64_t missing : {1ULL, 10ULL, 256ULL, 0x0102030405060708ULL, ~0ULL}) {
    const auto lines = lines_of(text.gap(missing));
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0].interface, kGapName);
    EXPECT_EQ(lines[0].frame.time_ns, 5'000'000);
    std::uint64_t read = 0;
    for (std::size_t i = 8; i-- > 0;) read = read * 256 + lines[0].frame.data[i];
    EXPECT_EQ(read, missing);
  }
}

}  // namespace
}  // namespace plumb::drivers::rt
