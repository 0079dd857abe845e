// SPDX-License-Identifier: Apache-2.0
#include "rt/replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <fstream>
#include <memory>
#include <optional>
#include <utility>

#include "plumb/drivers/can_codec.hpp"
#include "program/file.hpp"
#include "program/problem.hpp"
#include "rt/record_files.hpp"
#include "rt/record_line.hpp"
#include "rt/session_lines.hpp"

namespace plumb::drivers::rt {
namespace {

/// The frame as text, without time and interface, which are not compared.
std::string said(const CanFrame& frame) {
  const std::string line = to_line({"x", frame});
  return line.substr(line.rfind(' ') + 1);
}

using Models = std::vector<const LoadedModel*>;

const LoadedModel* find(const Models& models, std::uint32_t number) {
  const auto found = std::find_if(models.begin(), models.end(),
                                  [&](const auto* model) { return model->number() == number; });
  return found == models.end() ? nullptr : *found;
}

class Player {
 public:
  Player(const Deployment& deployment, Models models)
      : deployment_(deployment), models_(std::move(models)), layout_(record_layout(deployment)) {}

  /// A record that was made before there were lines `start` and `state` just begins.
  void open(const std::string& file) {
    file_ = file;
    line_ = 0;
    ++out_.files;
    expected_.clear();
    if (out_.files == 1) start_.emplace();
  }

  void take(const std::string& text) {
    ++out_.lines;
    ++line_;
    const auto line = parse_line(text);
    if (!line) {
      ++out_.unreadable;
    } else if (line->interface == kTickName) {
      step(tick_in(line->frame));
    } else if (line->interface == kStartName) {
      end_session();
      start_ = start_in(line->frame);
    } else if (line->interface == kStateName) {
      take_copy(line->frame);
    } else if (line->interface == kGapName) {
      ++out_.gaps;
      end_session();
    } else if (is_ours(line->frame)) {
      if (session_) compare(line->frame);
    } else {
      hear(line->frame);
    }
  }

  void close(std::size_t rest) { out_.torn += rest > 0 ? 1 : 0; }

  bool goes_on() const { return !out_.unknown_model; }

  /// The result. Frames missing from the last cycle are no difference, because a record may end
  /// anywhere (size limit, disk, power).
  Replayed result() && {
    if (session_) out_.report = session_->report();
    return std::move(out_);
  }

 private:
  bool is_ours(const CanFrame& frame) const {
    for (const MessageLayout& message : layout_.messages)
      if (message.sender == Sender::kPlumb && frame.id >= message.can_id &&
          frame.id < message.can_id + can_frames(layout_, message))
        return true;
    return false;
  }

  /// Before the first step of a run it is not known which model it began with.
  void hear(const CanFrame& frame) {
    if (!session_) {
      if (start_) early_.push_back(frame);
      return;
    }
    BusMessage message;
    if (heard_->hear(frame, message) != Heard::kComplete) return;
    message.time_ns = frame.time_ns;
    ++out_.messages;
    session_->hear(message);
  }

  /// Nothing can be compared until the record begins again.
  void end_session() {
    if (session_) out_.report = session_->report();
    session_.reset();
    start_.reset();
    early_.clear();
    expected_.clear();
  }

  /// Makes a session of the model with this number. False if that is unknown.
  bool make_session(std::uint32_t number, const SessionStart& start) {
    const LoadedModel* const model = find(models_, number);
    if (model == nullptr) {
      out_.unknown_model = number;
      return false;
    }
    SessionSettings settings = deployment_.session;
    settings.sensors = sensor_places(deployment_.layout, model->model());
    settings.start = start;
    slot_ = std::make_unique<ModelSlot>(*model);
    session_ = std::make_unique<Session>(*slot_, settings);
    heard_ = std::make_unique<CanCodec>(layout_);
    expected_.clear();
    ++out_.beginnings;
    return true;
  }

  /// The first step of a run.
  bool begin_run(std::uint32_t model) {
    if (!make_session(model, *start_)) return false;
    start_.reset();
    for (const CanFrame& frame : std::exchange(early_, {})) hear(frame);
    return true;
  }

  /// Goes on with a copy of the session, unless the present one has come to the same step.
  void take_copy(const CanFrame& frame) {
    const auto read = copy_.take(frame);
    if (read == SessionReader::Read::kDamaged) ++out_.unreadable;
    if (read == SessionReader::Read::kForeign) out_.foreign = true;
    if (read != SessionReader::Read::kComplete) return;
    const RecordedSession& recorded = copy_.session();
    const bool follows = session_ && recorded.time_ns == last_ns_ &&
                         recorded.cycles == session_->report().counters.cycles;
    if (follows) return;
    end_session();
    if (make_session(recorded.model, {})) session_->resume(recorded.copy, *slot_);
  }

  /// Changes to the model with this number. False if it is unknown or of another robot.
  bool has_model(std::uint32_t number) {
    if (number == session_->model()) return true;
    const LoadedModel* const next = find(models_, number);
    if (next == nullptr || slot_->publish(*next) != ModelSlot::Published::kDone) {
      out_.unknown_model = number;
      return false;
    }
    ++out_.swaps;
    return true;
  }

  void step(const RecordedTick& tick) {
    flush();
    if (!session_ && start_ && !begin_run(tick.model)) return;
    if (!session_) {
      ++out_.unchecked;
      return;
    }
    if (!has_model(tick.model)) return;
    ++out_.cycles;
    last_ns_ = tick.told.now_ns;
    const SessionOutput output = session_->step(tick.told);
    for (const BusMessage& message : output.sent())
      for (const CanFrame& frame : sent_.encode(message)) expected_.push_back(said(frame));
    out_.frames += expected_.size();
  }

  void compare(const CanFrame& frame) {
    const std::string now = expected_.empty() ? "nothing" : expected_.front();
    if (!expected_.empty()) expected_.pop_front();
    if (now != said(frame)) differ(said(frame), now);
  }

  /// Counts the frames of the previous cycle that are not in the record as differences.
  void flush() {
    for (const auto& now : expected_) differ("nothing", now);
    expected_.clear();
  }

  void differ(const std::string& recorded, const std::string& now) {
    if (++out_.different == 1)
      out_.first_difference =
          fmt::format("{}:{}: recorded {}, now {}", file_, line_, recorded, now);
  }

  const Deployment& deployment_;
  Models models_;
  BusLayout layout_;
  CanCodec sent_{layout_};
  std::unique_ptr<ModelSlot> slot_;
  std::unique_ptr<Session> session_;  // none: the record has not begun, or not after a gap
  std::unique_ptr<CanCodec> heard_;
  std::optional<SessionStart> start_;  // of a run whose first step is to come
  std::vector<CanFrame> early_;        // heard before it
  SessionReader copy_;
  std::int64_t last_ns_ = 0;  // time of the last step
  std::deque<std::string> expected_;
  std::string file_;
  std::uint64_t line_ = 0;
  Replayed out_;
};

}  // namespace

Replayed replay(const std::vector<std::filesystem::path>& files, const Deployment& deployment,
                const std::vector<RunningModel>& others) {
  Models models{deployment.model.loaded.get()};
  for (const RunningModel& other : others) models.push_back(other.loaded.get());
  Player player(deployment, models);
  for (const auto& file : files) {
    std::ifstream in(file);
    player.open(display_name(file));
    player.close(each_whole_line(in, [&](const std::string& line) {
      player.take(line);
      return player.goes_on();
    }));
    if (!player.goes_on()) break;
  }
  Replayed out = std::move(player).result();
  if (out.cycles > 0 || out.unknown_model) return out;
  const std::string first = display_name(files.front());
  throw Failure(
      Exit::kInput,
      {.code = "E-RT-REPLAY",
       .message = out.foreign ? fmt::format("{} goes on with a session that another version of "
                                            "plumb-rt copied, which this one cannot read",
                                            first)
                              : fmt::format("{} holds no cycle of plumb-rt", first),
       .help = out.foreign ? "replay it with the plumb-rt that wrote it, or from the start of a run"
                           : "record one: rt.toml, [log] record = \"record.log\""});
}

}  // namespace plumb::drivers::rt
