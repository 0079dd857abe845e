// SPDX-License-Identifier: Apache-2.0
// The calls of the cycle: nothing here allocates, locks or throws.
#include <limits>

#include "check.hpp"
#include "plumb/format/limits.hpp"
#include "pose.hpp"

namespace {

using namespace plumb;
using c::pose_of;
using c::transform_of;

static_assert(PLUMB_MAX_JOINTS == format::kMaxJoints);
static_assert(PLUMB_MAX_TEMPERATURES == format::kMaxTemperatures);
static_assert(PLUMB_STATUS_PARTIAL == static_cast<int>(Status::kPartial));
static_assert(PLUMB_STATUS_STALE == static_cast<int>(Status::kStale));

Reading reading_of(const plumb_input& in, std::uint32_t bit, const plumb_reading& came) noexcept {
  if ((in.arrived & bit) == 0) return {};
  // The reading did arrive, so an age of NaN means that its age is unknown: it counts as too old.
  const bool aged = came.age_s == came.age_s;
  return {came.value, aged ? came.age_s : std::numeric_limits<double>::infinity()};
}

ContextReadings readings_of(const plumb_input& in) noexcept {
  ContextReadings out;
  out.payload_kg = reading_of(in, PLUMB_PAYLOAD, in.payload_kg);
  std::copy_n(in.payload_com_m, 3, out.payload_com_m.begin());
  for (unsigned k = 0; k < PLUMB_MAX_TEMPERATURES; ++k)
    out.temperature_degC[k] = reading_of(in, PLUMB_TEMPERATURE(k), in.temperature_degC[k]);
  out.time_s = reading_of(in, PLUMB_TIME, in.time_s);
  return out;
}

CycleInput input_of(const plumb_input& in) noexcept {
  const auto came = [&in](std::uint32_t bits) {
    return (in.arrived & bits) != 0 ? Arrival::kArrived : Arrival::kNothingNew;
  };
  CycleInput out;
  out.now_ns = in.now_ns;
  out.target = came(PLUMB_TARGET);
  out.X_BD = transform_of(in.X_BD);
  out.joints = came(PLUMB_MEASURED | PLUMB_COMMANDED);
  if ((in.arrived & PLUMB_MEASURED) != 0)
    std::copy_n(in.q_measured, PLUMB_MAX_JOINTS, out.q_measured.begin());
  if ((in.arrived & PLUMB_COMMANDED) != 0)
    std::copy_n(in.q_commanded, PLUMB_MAX_JOINTS, out.q_commanded.begin());
  out.context = readings_of(in);
  return out;
}

plumb_output output_of(const CycleOutput& step) noexcept {
  plumb_output out{};
  out.has_output = step.output.has_output ? 1 : 0;
  out.status = static_cast<std::int32_t>(step.output.status);
  out.solved = static_cast<std::int32_t>(step.correction.status);
  out.X_BC = pose_of(step.output.X_BC);
  std::copy(step.correction.q.begin(), step.correction.q.end(), out.q);
  out.residual_m = step.correction.residual_m;
  out.residual_rad = step.correction.residual_rad;
  return out;
}

/// The output after an error: has_output is false, and all numbers are valid.
plumb_output no_output() noexcept {
  plumb_output out{};
  out.status = out.solved = PLUMB_STATUS_NO_MODEL;
  out.X_BC = pose_of({});
  return out;
}

plumb_prediction no_prediction() noexcept {
  plumb_prediction out{};
  out.status = PLUMB_STATUS_NO_MODEL;
  out.X_BT = pose_of({});
  return out;
}

plumb_prediction prediction_of(const Prediction& arm) noexcept {
  plumb_prediction out{};
  out.status = static_cast<std::int32_t>(arm.status);
  out.X_BT = pose_of(refused(arm.status) ? Transformd{} : arm.X_BT);
  for (int i = 0; i < 3; ++i) out.tree_m[i] = refused(arm.status) ? 0.0 : arm.tree_B(i);
  return out;
}

}  // namespace

extern "C" {

plumb_result plumb_input_init(plumb_input* input) {
  const plumb_result found = c::check_pointer(input);
  if (found != PLUMB_OK) return found;
  plumb_input nothing{};
  nothing.size = sizeof(plumb_input);
  nothing.X_BD = pose_of({});
  *input = nothing;
  return PLUMB_OK;
}

plumb_result plumb_correct(plumb_robot* robot, const plumb_input* input, plumb_output* output) {
  const plumb_result writable = c::check_struct(output);
  if (writable != PLUMB_OK) return writable;
  const plumb_result found = c::first_of(c::check_robot(robot), c::check_struct(input));
  if (found != PLUMB_OK) {
    c::copy_out(no_output(), output);
    return found;
  }
  const plumb_input in = c::copy_in(input);
  c::copy_out(output_of(robot->robot->correct(input_of(in))), output);
  return PLUMB_OK;
}

plumb_result plumb_enable(plumb_robot* robot, int on) {
  const plumb_result found = c::check_robot(robot);
  if (found != PLUMB_OK) return found;
  robot->robot->enable(on != 0 ? Guard::Enable::kOn : Guard::Enable::kOff);
  return PLUMB_OK;
}

plumb_result plumb_predict(const plumb_robot* robot, const plumb_joints* joints,
                           plumb_prediction* prediction) {
  const plumb_result writable = c::check_struct(prediction);
  if (writable != PLUMB_OK) return writable;
  const plumb_result found = c::first_of(c::check_robot(robot), c::check_struct(joints));
  if (found != PLUMB_OK) {
    c::copy_out(no_prediction(), prediction);
    return found;
  }
  const plumb_joints at = c::copy_in(joints);
  const auto q = std::span(at.q).first(static_cast<std::size_t>(robot->joints));
  c::copy_out(prediction_of(robot->robot->predict(q)), prediction);
  return PLUMB_OK;
}

plumb_result plumb_read_counters(const plumb_robot* robot, plumb_counters* counters) {
  const plumb_result writable = c::check_struct(counters);
  if (writable != PLUMB_OK) return writable;
  const plumb_result found = c::check_robot(robot);
  const GuardCounters now = found == PLUMB_OK ? robot->robot->counters() : GuardCounters{};
  plumb_counters out{};
  out.steps = now.steps;
  out.refused = now.refused;
  out.limited = now.limited;
  out.held = now.held;
  out.stale = now.stale;
  out.swaps = now.swaps;
  c::copy_out(out, counters);
  return found;
}

}  // extern "C"
