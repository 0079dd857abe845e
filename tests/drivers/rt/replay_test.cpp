// SPDX-License-Identifier: Apache-2.0
// Records that the test itself makes: a session, the messages that it heard, what it sent.
#include "rt/replay.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <sstream>

#include "plumb/drivers/bus_content.hpp"
#include "plumb/drivers/can_codec.hpp"
#include "rt/record_line.hpp"
#include "rt/record_text.hpp"
#include "tests/drivers/deployed.hpp"
#include "tests/drivers/rt/problem_of.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;
using What = RecordEntry::What;

/// A run of a deployment, on a bus that is its record.
class RecordedRun {
 public:
  explicit RecordedRun(const Deployment& deployment)
      : deployment_(deployment), slot_(*deployment.model.loaded) {
    SessionSettings settings = deployment.session;
    settings.sensors = sensor_places(deployment.layout, deployment.model.loaded->model());
    session_ = std::make_unique<Session>(slot_, settings);
    add(text_.start({}));
  }
  /// From the next step on.
  void swap_to(const LoadedModel& model) {
    EXPECT_EQ(slot_.publish(model), ModelSlot::Published::kDone);
  }
  void go(int more) {
    for (int i = 0; i < more; ++i) cycle();
  }
  void add(const std::string& text) {
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
  }
  std::string gap() const { return text_.gap(3); }

  std::vector<std::string> lines;
  std::vector<std::size_t> sent;   // numbers of the lines that the session sent, from 0
  std::vector<std::size_t> begun;  // and of those with which its cycles begin
  std::uint64_t told = 0;          // messages
  std::uint64_t cycles = 0;

 private:
  void cycle() {
    begun.push_back(lines.size());
    q_[0] += 1e-4;
    const Transformd X_BA = Chain(deployment_.model.loaded->model().nominal).forward(q_);
    const ControllerState state{
        .drives_on = true, .automatic = true, .protective_stop = false, .correction_enabled = true};
    for (const BusMessage& message :
         {controller_message(state, counter_), robot_message(deployment_.session.robot, counter_),
          joints_message(MessageKind::kJoints, q_, counter_),
          pose_message(MessageKind::kActual, X_BA, counter_),
          pose_message(MessageKind::kTarget, X_BA, counter_)})
      hear(message);
    ++counter_;
    RecordEntry step{.what = What::kTick, .tick = {.now_ns = now_ns_}};
    const SessionOutput out = session_->step(step.tick);
    step.model = session_->model();
    add(text_.entry(step, {}));
    for (const BusMessage& message : out.sent()) {
      const std::size_t before = lines.size();
      RecordEntry entry{.what = What::kSent, .tick = {}, .message = message};
      entry.message.time_ns = now_ns_;
      add(text_.entry(entry, {}));
      for (std::size_t i = before; i < lines.size(); ++i) sent.push_back(i);
    }
    ++cycles;
    now_ns_ += 1'000'000;
  }
  /// The session hears what the frames of the record hold.
  void hear(BusMessage message) {
    message.time_ns = now_ns_;
    const std::size_t before = lines.size();
    add(text_.entry({.what = What::kReceived, .tick = {}, .message = message}, {}));
    for (std::size_t i = before; i < lines.size(); ++i) {
      const auto line = parse_line(lines[i]);
      ASSERT_TRUE(line) << lines[i];
      BusMessage heard;
      if (codec_.hear(line->frame, heard) != Heard::kComplete) continue;
      heard.time_ns = line->frame.time_ns;
      session_->hear(heard);
      ++told;
    }
  }

  const Deployment& deployment_;
  ModelSlot slot_;
  std::unique_ptr<Session> session_;
  RecordText text_{record_layout(deployment_), "can0"};
  CanCodec codec_{record_layout(deployment_)};
  std::vector<double> q_{0.3, -1.0, 1.2, -0.4, 1.1, 0.2};
  std::uint16_t counter_ = 1;
  std::int64_t now_ns_ = 5'000'000'000;
};

class Replays : public testing::Test {
 protected:
  Replays() { run.go(1500); }
  fs::path write(const std::string& name, const std::vector<std::string>& lines,
                 const std::string& rest = "") const {
    std::ofstream out(folder.folder / name);
    for (const std::string& line : lines) out << line << "\n";
    out << rest;
    return folder.folder / name;
  }
  Replayed played(const std::vector<std::string>& lines, const std::string& rest = "") const {
    return replay({write("record.log", lines, rest)}, deployment, {});
  }
  /// A line that the session sent in the middle of the record.
  std::size_t sent_line() const { return run.sent.at(run.sent.size() / 2); }
  /// The line with which a cycle begins there.
  std::size_t cycle_line() const { return run.begun.at(run.begun.size() / 2); }
  static std::vector<std::string> part(const std::vector<std::string>& lines, std::size_t from,
                                       std::size_t to) {
    return {lines.begin() + static_cast<std::ptrdiff_t>(from),
            lines.begin() + static_cast<std::ptrdiff_t>(to)};
  }

  const tests::Deployed folder;
  const Deployment deployment = load_deployment(folder.folder);
  RecordedRun run{deployment};
};

TEST_F(Replays, WhatASessionSaidIsSaidAgainFrameByFrame) {
  const Replayed again = played(run.lines);
  EXPECT_TRUE(again.same()) << again.first_difference;
  EXPECT_EQ(again.cycles, run.cycles);
  EXPECT_EQ(again.lines, run.lines.size());
  EXPECT_EQ(again.messages, run.told);
  EXPECT_EQ(again.frames, run.sent.size());
  EXPECT_EQ(again.beginnings, 1U);
  EXPECT_EQ(again.report.state, SessionState::kActive);
  EXPECT_GT(again.report.counters.answered, 100U) << "there was something to compare";
}

TEST_F(Replays, AFrameThatWasSaidOtherwiseIsFoundAtItsLine) {
  for (const std::size_t at : {run.sent.front(), sent_line(), run.sent.back()}) {
    auto lines = run.lines;
    char& last = lines[at].back();
    last = last == '0' ? '1' : '0';
    const Replayed again = played(lines);
    EXPECT_FALSE(again.same());
    EXPECT_EQ(again.different, 1U);
    const std::string place = "record.log:" + std::to_string(at + 1) + ": ";
    EXPECT_NE(again.first_difference.find(place), std::string::npos) << again.first_difference;
  }
}

TEST_F(Replays, AFrameThatIsMissingOrTooManyIsADifference) {
  const std::size_t at = sent_line();
  auto missing = run.lines, twice = run.lines;
  missing.erase(missing.begin() + static_cast<std::ptrdiff_t>(at));
  twice.insert(twice.begin() + static_cast<std::ptrdiff_t>(at), twice[at]);
  for (const auto& lines : {missing, twice}) EXPECT_GT(played(lines).different, 0U);
}

/// The record is that of one model; another one would have said something else.
TEST_F(Replays, AnotherModelIsNotTakenForTheOneThatRan) {
  folder.write_model("robot.plumb", tests::Deployed::arm());
  format::Model other = tests::Deployed::arm();
  other.calibrated.joints[1].a += 1e-4;
  folder.write_model("other.plumb", other);
  folder.write("rt.toml", tests::Deployed::csv("[model]\nfile = \"other.plumb\"\n"));
  const Deployment wrong = load_deployment(folder.folder);
  const auto file = write("record.log", run.lines);
  const Replayed without = replay({file}, wrong, {});
  ASSERT_TRUE(without.unknown_model);
  EXPECT_EQ(*without.unknown_model, deployment.model.loaded->number());
  EXPECT_FALSE(without.same());
  EXPECT_EQ(without.cycles, 0U);
  std::vector<RunningModel> others;
  others.push_back(load_model(folder.folder / "robot.plumb", ""));
  EXPECT_TRUE(replay({file}, wrong, others).same());
}

TEST_F(Replays, ASwapHappensInTheCycleInWhichItDid) {
  format::Model better = tests::Deployed::arm();
  better.calibrated.joints[1].a += 1e-4;
  folder.write_model("better.plumb", better);
  std::vector<RunningModel> others;
  others.push_back(load_model(folder.folder / "better.plumb", ""));
  run.swap_to(*others.front().loaded);
  run.go(300);
  const auto file = write("record.log", run.lines);
  const Replayed again = replay({file}, deployment, others);
  EXPECT_TRUE(again.same()) << again.first_difference;
  EXPECT_EQ(again.swaps, 1U);
  EXPECT_EQ(again.cycles, run.cycles);
  const Replayed alone = replay({file}, deployment, {});
  EXPECT_EQ(alone.unknown_model, others.front().loaded->number());
  EXPECT_EQ(alone.cycles, run.cycles - 300) << "up to there it is played";
}

/// Nobody knows the session behind a gap until the record begins again.
TEST_F(Replays, CyclesBehindAGapAreNotComparedAndNotCalledTheSame) {
  const std::size_t half = cycle_line();
  auto lines = part(run.lines, 0, half);
  std::istringstream gap(run.gap());
  std::string line;
  std::getline(gap, line);
  lines.push_back(line);
  const auto rest = part(run.lines, half, run.lines.size());
  lines.insert(lines.end(), rest.begin(), rest.end());
  const Replayed again = played(lines);
  EXPECT_EQ(again.gaps, 1U);
  EXPECT_EQ(again.different, 0U);
  EXPECT_EQ(again.cycles + again.unchecked, run.cycles);
  EXPECT_GT(again.unchecked, 0U);
  EXPECT_FALSE(again.same());
}

TEST_F(Replays, FilesGoOnFromEachOtherAndWhatAKilledProgramLeftIsPassedOver) {
  const std::size_t half = cycle_line();
  const auto one = write("1.log", part(run.lines, 0, half), run.lines[half].substr(0, 9));
  const auto two = write("2.log", part(run.lines, half, run.lines.size()));
  const Replayed both = replay({one, two}, deployment, {});
  EXPECT_TRUE(both.same()) << both.first_difference;
  EXPECT_EQ(both.files, 2U);
  EXPECT_EQ(both.torn, 1U);
  EXPECT_EQ(both.cycles, run.cycles);
}

/// A record may end anywhere: within the frames of its last cycle too.
TEST_F(Replays, ARecordThatEndsAnywhereIsTheSame) {
  const std::size_t at = sent_line() - 6;
  for (std::size_t end = at; end < at + 12; ++end)
    EXPECT_TRUE(played(part(run.lines, 0, end)).same()) << end;
}

TEST_F(Replays, ALineThatIsNoneIsCountedAndSpoilsIt) {
  auto lines = run.lines;
  lines.insert(lines.begin() + 50, "no line of a record");
  const Replayed again = played(lines);
  EXPECT_EQ(again.unreadable, 1U);
  EXPECT_EQ(again.different, 0U);
  EXPECT_FALSE(again.same());
}

TEST_F(Replays, AFileWithoutACycleIsRefused) {
  for (const auto& lines :
       {std::vector<std::string>{}, {std::string("hello")}, part(run.lines, 0, 1)})
    EXPECT_EQ(tests::problem_of([&] { std::ignore = played(lines); }).code, "E-RT-REPLAY");
}

}  // namespace
}  // namespace plumb::drivers::rt
