// SPDX-License-Identifier: Apache-2.0
#include "deploy/rt_toml.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "bus_text/layout_toml.hpp"
#include "cell/host_and_port.hpp"
#include "cell/toml_text.hpp"
#include "plumb/drivers/session.hpp"
#include "plumb/drivers/session_transition.hpp"

namespace plumb::offline {
namespace {

constexpr double kMilli = 1e-3, kMicro = 1e-6, kDegree = std::numbers::pi / 180.0;

/// The key by which plumb-rt install tells an older folder from a newer one; nothing if empty.
std::string made_line(const std::string& made) {
  return made.empty()
             ? ""
             : fmt::format("made = \"{}\"   # an older one is installed only on purpose\n", made);
}

std::string head(const Cell& cell, const std::string& made) {
  return fmt::format(
      "schema = \"rt/1\"   # read by plumb-rt run; after editing: plumb-rt seal FOLDER\n\n"
      "[model]\nfile = \"robot.plumb\"\nserial = {}   # the robot's; refused if the model is of "
      "another\n{}\n"
      "[cycle]\ncycle_us = {:.10g}\npriority = 80   # of SCHED_FIFO; 0: an ordinary thread\n"
      "cpu = -1   # to stay on; -1: any\n"
      "give_up_s = 0   # end with exit code 6 when the bus is down for so long; 0: never\n\n",
      toml_string(cell.serial), made_line(made), cell.deploy.cycle_s / kMicro);
}

/// Tables [source] and [sink] for the link of the cell; comments show the other kinds.
std::string source(const DeploySettings& deploy) {
  const bool can = deploy.link == drivers::BusUse::kCan;
  const std::string on_can =
      fmt::format("kind = \"can\"\ninterface = {}\n", toml_string(deploy.interface));
  const auto [host, port] = host_and_port(deploy.address);
  const std::string on_modbus = fmt::format(
      "kind = \"modbus\"\nrole = \"client\"   # or \"server\": the controller polls us\n"
      "address = {}   # of the controller; role server: to listen on\nport = {}\nunit = 1\n",
      toml_string(host), port.empty() ? "502" : port);
  return "[source]   # of desired targets: kind = \"can\", \"modbus\" or \"csv\"\n" +
         (can ? on_can : on_modbus) +
         "# CSV: kind = \"csv\", file = \"targets.csv\"; Modbus RTU: device = \"/dev/ttyUSB0\", "
         "baud = 115200;\n# Modbus TCP server: peers = [\"192.168.0.10\"], who may connect; "
         "without it refused\n\n"
         "[sink]\nkind = \"same\"   # where the targets came from; or \"csv\" with file = "
         "\"corrected.csv\"\n\n";
}

/// A number that is not below the value, so that the model itself keeps its ceiling.
double rounded_up(double value) { return std::ceil(value * 1e6 * (1.0 - 1e-9)) / 1e6; }

/// What no model may exceed, whatever it says of itself.
std::string ceilings(const format::GuardLimits& guard) {
  return fmt::format(
      "max_correction_mm = {:.10g}   # ceilings: a model that allows itself more is refused\n"
      "max_rotation_deg = {:.10g}\n"
      "max_slew_mm_s = {:.10g}\nmax_slew_deg_s = {:.10g}\n"
      "min_ramp_s = {:.10g}\n"
      "# max_change_mm, max_change_deg: by which a swap may change the correction of a pose\n\n",
      rounded_up(guard.max_correction_m / kMilli), rounded_up(guard.max_rotation_rad / kDegree),
      rounded_up(guard.slew_m_per_s / kMilli), rounded_up(guard.slew_rad_per_s / kDegree),
      guard.ramp_s);
}

std::string limits(const format::GuardLimits& guard, drivers::CorrectionMode mode) {
  const drivers::SessionSettings s;
  return fmt::format(
             "[limits]\nmode = \"{}\"   # \"shadow\": computes and reports, sends no correction; "
             "then \"limited\", "
             "then \"full\"\n"
             "target_speed_mm_s = {:.10g}   # of desired targets; faster ones are refused\n"
             "target_speed_deg_s = {:.10g}\n"
             "target_step_mm = {:.10g}   # from one target to the next\ntarget_step_deg = {:.10g}\n"
             "limited_mm = {:.10g}   # largest correction of mode limited\n"
             "limited_scale = {:.10g}   # and its share of the whole\n"
             "arm_distance_mm = {:.10g}   # how far the arm may be from the path of the targets\n"
             "arm_distance_deg = {:.10g}\narm_lag_s = {:.10g}   # and by how much it may be late\n",
             drivers::to_string(mode), s.target.speed_m_s / kMilli, s.target.speed_rad_s / kDegree,
             s.target.step_m / kMilli, s.target.step_rad / kDegree, s.share.limited_m / kMilli,
             s.share.limited_scale, s.arm.distance_m / kMilli, s.arm.angle_rad / kDegree,
             s.arm.lag_s) +
         ceilings(guard);
}

std::string checks() {
  const drivers::SyncSettings sync;
  return fmt::format(
      "[expect]   # the controller's numbers; others hold the correction\n"
      "# tool = 1\n# frame = 0\n# payload = 1\n\n"
      "[sync]   # before any correction: does the controller compute poses as the nominal model?\n"
      "poses = {}\nposition_um = {:.10g}\nrotation_urad = {:.10g}\n"
      "distinct = {}   # of them, apart by 0.1 rad; 1: the arm may stand still\n"
      "silence_s = {:.10g}   # longest time without a compared pose\n\n"
      "[log]\n# record = \"record.log\"   # every frame, in the format of candump\n"
      "metrics_port = 0   # for Prometheus on 127.0.0.1; 0: none\n\n"
      "[record]   # what is kept of it; the oldest files are removed\n"
      "max_file_mb = 100\nmax_total_mb = 1000   # of all its files; 0: no limit\n"
      "max_age_days = 30\nfree_space_floor_mb = 200   # of the disk, which it leaves free\n"
      "snapshots = 10   # kept of faults, and as many of holds, also without a record; 0: none\n"
      "before_s = 10   # what a snapshot holds before a fault\n"
      "after_s = 5   # and after it\n\n",
      sync.poses, sync.position_m / kMicro, sync.rotation_rad / kMicro, sync.distinct,
      sync.silence_s);
}

}  // namespace

std::string write_rt_toml(const Cell& cell, const drivers::BusLayout& layout,
                          const format::GuardLimits& guard, drivers::CorrectionMode mode,
                          const std::string& made) {
  return head(cell, made) + source(cell.deploy) + limits(guard, mode) + checks() +
         drivers::write_bus(layout, "bus");
}

}  // namespace plumb::offline
