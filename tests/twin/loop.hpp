// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <deque>

#include "plumb/drivers/session.hpp"
#include "plumb/runtime/loaded_model.hpp"
#include "twin/controller.hpp"
#include "twin/ports.hpp"

namespace plumb::offline::twin {

/// CAN frames from one end to the other, in memory.
class MemoryWire final : public CanWire {
 public:
  using Frames = std::deque<drivers::CanFrame>;
  MemoryWire(Frames& out, Frames& in) : out_(out), in_(in) {}
  bool write(const drivers::CanFrame& frame) noexcept override {
    out_.push_back(frame);
    return true;
  }
  bool read(drivers::CanFrame& frame) noexcept override {
    if (in_.empty()) return false;
    frame = in_.front();
    in_.pop_front();
    return true;
  }
  drivers::LinkState state() const noexcept override { return drivers::LinkState::kUp; }

 private:
  Frames& out_;
  Frames& in_;
};

/// What plumb-rt is in this loop.
struct OurSide {
  drivers::CorrectionMode mode = drivers::CorrectionMode::kFull;
  double dies_s = INFINITY;  // since the start
  double back_s = INFINITY;
};

/// The controller and the session of plumb-rt, with the codec's frames between them, in virtual
/// time: each cycle the one speaks, then the other.
class Loop {
 public:
  Loop(const Cell& cell, const LoadedModel& model, const Path& path, FaultPlan faults,
       const drivers::BusLayout& layout, const OurSide& side, const ControllerSettings& settings)
      : faults_(std::move(faults)),
        side_(side),
        cycle_ns_(std::llround(settings.cycle_s * 1e9)),
        settings_(session_settings(cell, model, layout, side, settings)),
        slot_(model),
        session_(slot_, settings_),
        wire_(to_plumb_, to_controller_),
        port_(wire_, layout, faults_, time_, 1),
        ours_(layout),
        controller_(cell, path, settings, Controller::Corrections::kUse, layout, faults_, time_) {}

  Controller& controller() { return controller_; }
  const drivers::Session& session() const { return session_; }
  const drivers::PortCounters& heard() const { return heard_; }
  double now_s() const { return 1e-9 * static_cast<double>(now_ns_); }

  /// Until the path is driven, or this time. False: it is not.
  bool run(double longest_s) {
    while (!controller_.done() && now_s() < longest_s) cycle();
    return controller_.done() && !controller_.gave_up();
  }

  void cycle() {
    now_ns_ += cycle_ns_;
    controller_.cycle(now_ns_, &port_);
    if (now_s() >= side_.dies_s && now_s() < side_.back_s) return died();
    hear();
    speak(session_.step({.now_ns = now_ns_, .foreign_senders = 0}));
  }

 private:
  static drivers::SessionSettings session_settings(const Cell& cell, const LoadedModel& model,
                                                   const drivers::BusLayout& layout,
                                                   const OurSide& side,
                                                   const ControllerSettings& controller) {
    drivers::SessionSettings out;
    out.mode = side.mode;
    out.form = layout.correction;
    out.robot = drivers::fingerprint(cell.serial);
    out.sensors = drivers::sensor_places(layout, model.model());
    out.cycle_s = out.target.period_s = controller.cycle_s;
    return out;
  }

  void died() {
    to_plumb_.clear();
    session_ = drivers::Session(slot_, settings_);
  }

  void hear() {
    drivers::BusMessage message;
    while (!to_plumb_.empty()) {
      drivers::CanFrame frame = to_plumb_.front();
      to_plumb_.pop_front();
      frame.time_ns = now_ns_;
      const auto worth = ours_.hear(frame, message);
      if (worth == drivers::Heard::kCorrupt) ++heard_.corrupt;
      if (worth == drivers::Heard::kRepeated) ++heard_.repeated;
      if (worth != drivers::Heard::kComplete) continue;
      ++heard_.received;
      session_.hear(message);
    }
  }

  void speak(const drivers::SessionOutput& output) {
    for (const auto& message : output.sent())
      for (const auto& frame : ours_.encode(message)) to_controller_.push_back(frame);
  }

  FaultPlan faults_;
  OurSide side_;
  std::int64_t cycle_ns_;
  std::int64_t now_ns_ = 0;
  drivers::SessionSettings settings_;
  ModelSlot slot_;
  drivers::Session session_;
  MemoryWire::Frames to_plumb_, to_controller_;
  TwinTime time_;
  MemoryWire wire_;
  FaultyCanPort port_;
  drivers::CanCodec ours_;
  drivers::PortCounters heard_;
  Controller controller_;
};

}  // namespace plumb::offline::twin
