// SPDX-License-Identifier: Apache-2.0
#include "check.hpp"
#include "plumb/format/version.hpp"

extern "C" {

int plumb_joint_count(const plumb_robot* robot) {
  return plumb::c::check_robot(robot) == PLUMB_OK ? robot->joints : 0;
}

const char* plumb_serial(const plumb_robot* robot) {
  return plumb::c::check_robot(robot) == PLUMB_OK ? robot->serial.c_str() : "";
}

const char* plumb_temperature_name(const plumb_robot* robot, int k) {
  if (plumb::c::check_robot(robot) != PLUMB_OK || k < 0 || k >= robot->sensor_count) return nullptr;
  return robot->sensors[static_cast<std::size_t>(k)].c_str();
}

const char* plumb_status_text(std::int32_t status) {
  const bool known = status >= PLUMB_STATUS_STALE && status <= PLUMB_STATUS_PARTIAL;
  return known ? plumb::to_string(static_cast<plumb::Status>(status)) : "unknown";
}

const char* plumb_result_text(std::int32_t result) {
  switch (result) {
    case PLUMB_OK:
      return "done";
    case PLUMB_NULL:
      return "a pointer is null";
    case PLUMB_MISALIGNED:
      return "a pointer is not aligned for its struct";
    case PLUMB_BAD_SIZE:
      return "the size of a struct is not set";
    case PLUMB_NOT_A_ROBOT:
      return "not a loaded robot";
    case PLUMB_UNREADABLE:
      return "the model cannot be read";
    case PLUMB_UNKNOWN_EFFECT:
      return "the model needs an effect that this version does not have";
    case PLUMB_OTHER_ROBOT:
      return "the model was made for another robot";
    case PLUMB_BUSY:
      return "the cycle has not taken the last model yet";
    case PLUMB_NO_MEMORY:
      return "out of memory";
    case PLUMB_BAD_NUMBER:
      return "a setting is negative, infinite or no number";
    case PLUMB_RUNNING:
      return "the cycle has begun";
    default:
      return "unknown";
  }
}

const char* plumb_version(void) { return plumb::format::kVersion; }

}  // extern "C"
