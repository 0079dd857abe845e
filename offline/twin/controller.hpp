// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "plumb/drivers/bus_content.hpp"
#include "plumb/drivers/bus_layout.hpp"
#include "plumb/drivers/bus_port.hpp"
#include "twin/fault.hpp"
#include "twin/nominal_arm.hpp"
#include "twin/path.hpp"
#include "twin/receiver.hpp"
#include "twin/surroundings.hpp"
#include "twin/twin_time.hpp"

namespace plumb::offline::twin {

/// How the simulated controller drives.
struct ControllerSettings {
  double cycle_s = 0.004;
  SpeedLimits fastest = {};
  double servo_s = 0.010;        // time constant of the position loop
  double dwell_s = 0.15;         // at every station, at least
  double longest_dwell_s = 3.0;  // while the correction still moves
  double wait_s = 30.0;          // for corrections, before the path begins; 0: begins at once
  std::uint8_t tool = 1, frame = 1, payload = 1;
  Receiver::Settings receiver = {};
};

/// The arm at rest at a station.
struct Stop {
  int station = 0;
  VectorXd q;       // encoders [rad, m]
  Isometry3d X_BD;  // where the tool is meant to be
  Offset offset;    // the correction that was applied
  bool settled = true;
  double path_s = 0.0;  // since the path began
};

/// plumb-rt went into a state.
struct StateSeen {
  drivers::SessionState state = drivers::SessionState::kInit;
  double path_s = -1.0;  // since the path began; negative before
};

/// Monotone, of one run.
struct ControllerCounters {
  std::uint64_t cycles = 0;
  std::uint64_t no_inverse = 0;  // corrected targets that the nominal arm does not reach
  double largest_step_m = 0.0;   // of the applied correction, from cycle to cycle
  double largest_offset_m = 0.0;
  double first_active_s = -1.0;  // since the start; -1: never
};

/// A robot controller that knows its nominal arm only. Every cycle it says where it is and where it
/// is going, listens for corrections, and drives to the corrected target with its own inverse.
/// Before the path it goes to and fro between the first two stations until corrections are there.
///
/// Thread: one.
class Controller {
 public:
  /// kIgnore: sends and hears nothing.
  enum class Corrections { kIgnore, kUse };

  Controller(const Cell& cell, const Path& path, const ControllerSettings& settings,
             Corrections corrections, const drivers::BusLayout& layout, const FaultPlan& faults,
             TwinTime& time);

  /// What an option for absolute accuracy would know of the arm; for FaultKind::kAbsolute.
  void knows(const format::Chain& own) { own_.emplace(own); }

  /// What its sensors read at each station; without it, it sends no context.
  void feels(std::vector<Readings> along) { along_ = std::move(along); }

  /// One cycle; `port` may be null if corrections are ignored.
  void cycle(std::int64_t now_ns, drivers::BusPort* port);

  /// Stopped at every station, or gave up waiting for corrections.
  bool done() const { return gave_up_ || station_ >= path_.stations(); }
  bool gave_up() const { return gave_up_; }
  const std::vector<Stop>& stops() const { return stops_; }
  const ControllerCounters& counters() const { return counters_; }
  const Receiver& receiver() const { return receiver_; }
  const drivers::SessionStatus& session() const { return session_; }
  const std::vector<StateSeen>& states() const { return states_; }
  double session_age_s() const;  // since plumb-rt's status last came; infinite: never

 private:
  enum class Phase { kApproach, kPath };

  bool fault(FaultKind kind) const { return faults_.active(kind, time_.path_s); }
  void reboot();
  void hear(drivers::BusPort& port);
  void hear_status(const drivers::BusMessage& message);
  void advance();
  void arrive();
  void set_out(const VectorXd& to);
  bool corrections_are_there() const;
  bool at_rest() const;
  void drive();
  void say(drivers::BusPort& port);
  void say_context(drivers::BusPort& port);
  void say(drivers::BusPort& port, const drivers::BusMessage& message);
  Isometry3d shown_pose() const;
  drivers::ControllerState state() const;

  const Path& path_;
  ControllerSettings settings_;
  Corrections corrections_;
  const FaultPlan& faults_;
  TwinTime& time_;
  NominalArm arm_;
  std::optional<NominalArm> own_;
  std::uint32_t serial_;
  std::vector<std::pair<drivers::MessageKind, std::uint64_t>> every_;  // cycles between messages
  std::optional<drivers::MessageLayout> context_;
  std::vector<Readings> along_;  // by station

  Phase phase_ = Phase::kApproach;
  Move move_;
  double move_s_ = 0.0;  // into the move
  double rest_s_ = 0.0;  // since it ended
  int station_ = 0;      // that is driven to
  bool to_and_fro_ = false;
  bool was_down_ = false;
  bool gave_up_ = false;

  VectorXd q_path_, q_commanded_, q_measured_, q_frozen_;
  Isometry3d X_BD_;
  Receiver receiver_;
  std::vector<Offset> recent_;  // of the last moments, for rest
  std::uint16_t counter_ = 0;
  std::int64_t start_ns_ = 0, path_ns_ = 0, status_ns_ = 0;
  bool has_status_ = false;
  drivers::SessionStatus session_;
  std::vector<StateSeen> states_;
  std::vector<Stop> stops_;
  ControllerCounters counters_;
};

}  // namespace plumb::offline::twin
