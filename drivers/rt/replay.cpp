// SPDX-License-Identifier: Apache-2.0
#include "rt/replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <fstream>
#include <memory>

#include "plumb/drivers/can_codec.hpp"
#include "program/file.hpp"
#include "program/problem.hpp"
#include "rt/record_line.hpp"

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

/// What a record begins with.
struct Beginning {
  const LoadedModel* model;  // the first of the record, if it is known; else that of the deployment
  SessionStart start;
};

Beginning beginning_of(const Models& models, const std::filesystem::path& record) {
  Beginning out{.model = models.front(), .start = {}};
  std::ifstream in(record);
  for (std::string text; std::getline(in, text);) {
    const auto line = parse_line(text);
    if (line && line->interface == kStartName) out.start = start_in(line->frame);
    if (!line || line->interface != kTickName) continue;
    const LoadedModel* const found = find(models, tick_in(line->frame).model);
    if (found != nullptr) out.model = found;
    break;
  }
  return out;
}

/// The settings of a run that began so.
SessionSettings settings_with(const Deployment& deployment, const Beginning& first) {
  SessionSettings out = deployment.session;
  out.sensors = sensor_places(deployment.layout, first.model->model());
  out.start = first.start;
  return out;
}

class Player {
 public:
  Player(const Deployment& deployment, Models models, const Beginning& first)
      : models_(std::move(models)),
        slot_(*first.model),
        session_(std::make_unique<Session>(slot_, settings_with(deployment, first))),
        heard_(record_layout(deployment)),
        sent_(record_layout(deployment)),
        layout_(record_layout(deployment)) {}

  void take(const std::string& text) {
    ++out_.lines;
    const auto line = parse_line(text);
    if (!line) {
      ++out_.unreadable;
    } else if (line->interface == kTickName) {
      step(tick_in(line->frame));
    } else if (line->interface == kStartName) {
      return;
    } else if (line->interface == kGapName) {
      ++out_.gaps;
    } else if (is_ours(line->frame)) {
      compare(line->frame);
    } else {
      hear(line->frame);
    }
  }

  bool goes_on() const { return !out_.unknown_model; }

  /// The result. Frames missing from the last cycle are no difference, because a record may end
  /// anywhere (size limit, disk, power).
  Replayed result() && {
    out_.report = session_->report();
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

  void hear(const CanFrame& frame) {
    BusMessage message;
    if (heard_.hear(frame, message) != Heard::kComplete) return;
    message.time_ns = frame.time_ns;
    ++out_.messages;
    session_->hear(message);
  }

  /// Changes to the model with this number. False if it is unknown or of another robot.
  bool has_model(std::uint32_t number) {
    if (number == session_->model()) return true;
    const LoadedModel* const next = find(models_, number);
    if (next == nullptr || slot_.publish(*next) != ModelSlot::Published::kDone) {
      out_.unknown_model = number;
      return false;
    }
    ++out_.swaps;
    return true;
  }

  void step(const RecordedTick& tick) {
    flush();
    if (!has_model(tick.model)) return;
    ++out_.cycles;
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
          fmt::format("line {}: recorded {}, now {}", out_.lines, recorded, now);
  }

  Models models_;
  ModelSlot slot_;
  std::unique_ptr<Session> session_;
  CanCodec heard_;
  CanCodec sent_;
  BusLayout layout_;
  std::deque<std::string> expected_;
  Replayed out_;
};

}  // namespace

Replayed replay(const std::filesystem::path& record, const Deployment& deployment,
                const std::vector<RunningModel>& others) {
  Models models{deployment.model.loaded.get()};
  for (const RunningModel& other : others) models.push_back(other.loaded.get());
  Player player(deployment, models, beginning_of(models, record));
  std::ifstream in(record);
  for (std::string line; player.goes_on() && std::getline(in, line);) player.take(line);
  Replayed out = std::move(player).result();
  if (out.cycles > 0 || out.unknown_model) return out;
  throw Failure(Exit::kInput,
                {.code = "E-RT-REPLAY",
                 .message = fmt::format("{} holds no cycle of plumb-rt", display_name(record)),
                 .help = "record one: rt.toml, [log] record = \"record.log\""});
}

}  // namespace plumb::drivers::rt
