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

/// The settings of the simulated controller.
struct ControllerSettings {
  double cycle_s = 0.004;
  SpeedLimits fastest = {};
  double servo_s = 0.010;        // time constant of the position loop
  double dwell_s = 0.15;         // shortest time at a station
  double longest_dwell_s = 3.0;  // longest time to wait until the correction rests
  double wait_s = 30.0;          // longest wait for corrections before the path; 0: none
  std::uint8_t tool = 1, frame = 1, payload = 1;
  Receiver::Settings receiver = {};
};

/// The arm at rest at a station.
struct Stop {
  int station = 0;
  VectorXd q;       // encoder readings [rad, m]
  Isometry3d X_BD;  // the pose that the tool should have
  Offset offset;    // the correction that was applied
  bool settled = true;
  double path_s = 0.0;  // since the path began
};

/// A state that plumb-rt entered, as the controller saw it.
struct StateSeen {
  drivers::SessionState state = drivers::SessionState::kInit;
  double path_s = -1.0;  // since the path began; negative before
};

/// Counters and largest values of one run; they only grow.
struct ControllerCounters {
  std::uint64_t cycles = 0;
  std::uint64_t no_inverse = 0;  // corrected targets that the nominal arm does not reach
  double largest_step_m = 0.0;   // largest change of the applied correction in a cycle
  double largest_offset_m = 0.0;
  double first_active_s = -1.0;  // time since the start; -1 if never
};

/// A robot controller that knows the nominal arm only. In every cycle it sends its actual pose and
/// its target, receives corrections, and moves to the corrected target with its own inverse
/// kinematics. Before the path begins it moves to the first stations and back, each time one
/// farther, until corrections arrive. Its operator acknowledges a plumb-rt that stays in SHADOW,
/// which may wait for that, but no FAULT.
///
/// To be used by one thread.
class Controller {
 public:
  /// kIgnore: it sends and receives nothing.
  enum class Corrections { kIgnore, kUse };

  Controller(const Cell& cell, const Path& path, const ControllerSettings& settings,
             Corrections corrections, const drivers::BusLayout& layout, const FaultPlan& faults,
             TwinTime& time);

  /// Gives the controller the chain that an absolute-accuracy option would use, for
  /// FaultKind::kAbsolute.
  void knows(const format::Chain& own) { own_.emplace(own); }

  /// Sets the readings of its sensors at each station. Without them it sends no context.
  void feels(std::vector<Readings> along) { along_ = std::move(along); }

  /// One cycle; `port` may be null if corrections are ignored.
  void cycle(std::int64_t now_ns, drivers::BusPort* port);

  /// True once it has stopped at every station or given up waiting for corrections.
  bool done() const { return gave_up_ || station_ >= path_.stations(); }
  bool gave_up() const { return gave_up_; }
  const std::vector<Stop>& stops() const { return stops_; }
  const ControllerCounters& counters() const { return counters_; }
  const Receiver& receiver() const { return receiver_; }
  const drivers::SessionStatus& session() const { return session_; }
  const std::vector<StateSeen>& states() const { return states_; }
  double session_age_s() const;  // time since the last status of plumb-rt; infinite if none came

 private:
  enum class Phase { kApproach, kPath };

  bool fault(FaultKind kind) const { return faults_.active(kind, time_.path_s); }
  void reboot();
  void hear(drivers::BusPort& port);
  void hear_status(const drivers::BusMessage& message);
  Receiver::Own own_state() const;
  void stand();
  void set_out_again();
  void advance();
  void arrive();
  void walk_on();
  void set_out(const VectorXd& to);
  bool corrections_are_there() const;
  bool at_rest() const;
  void drive();
  void say(drivers::BusPort& port);
  void say_context(drivers::BusPort& port);
  void say(drivers::BusPort& port, const drivers::BusMessage& message);
  Isometry3d shown_pose() const;
  drivers::ControllerState state() const;
  bool operator_acknowledges() const;

  const Path& path_;
  ControllerSettings settings_;
  Corrections corrections_;
  const FaultPlan& faults_;
  TwinTime& time_;
  NominalArm arm_;
  std::optional<NominalArm> own_;
  std::uint32_t serial_;
  std::vector<std::pair<drivers::MessageKind, std::uint64_t>> every_;  // its period in cycles
  std::optional<drivers::MessageLayout> context_;
  std::vector<Readings> along_;  // one for each station

  Phase phase_ = Phase::kApproach;
  Move move_;
  double move_s_ = 0.0;  // time since the move began
  double rest_s_ = 0.0;  // time since the move ended
  int station_ = 0;      // the station that the arm moves to
  int walk_ = 0;         // the station that it moves to before the path begins
  int farthest_ = 1;     // where it turns
  bool back_ = false;
  bool was_down_ = false;
  bool stood_ = false;  // in the cycle before
  bool gave_up_ = false;

  VectorXd q_path_, q_commanded_, q_measured_, q_frozen_;
  Isometry3d X_BD_;
  Receiver receiver_;
  std::vector<Offset> recent_;  // the last corrections, to tell whether they rest
  std::uint16_t counter_ = 0;
  std::int64_t start_ns_ = 0, path_ns_ = 0, status_ns_ = 0;
  bool has_status_ = false;
  std::int64_t shadow_ns_ = 0;  // since when plumb-rt has been in SHADOW; 0: it is not
  drivers::SessionStatus session_;
  std::vector<StateSeen> states_;
  std::vector<Stop> stops_;
  ControllerCounters counters_;
};

}  // namespace plumb::offline::twin
