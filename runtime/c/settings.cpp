// SPDX-License-Identifier: Apache-2.0
// The calls that change the settings of the cycle before its first step.
#include <cfloat>

#include "check.hpp"

namespace {

using namespace plumb;

plumb_settings settings_of(const CycleSettings& settings) noexcept {
  plumb_settings out{};
  out.size = sizeof out;
  out.target_limit_s = settings.target_limit_s;
  out.joints_limit_s = settings.joints_limit_s;
  out.payload_limit_s = settings.context.payload_s;
  out.temperature_limit_s = settings.context.temperature_s;
  out.time_limit_s = settings.context.time_s;
  out.dead_band_rad = settings.dead_band;
  return out;
}

CycleSettings settings_of(const plumb_settings& settings) noexcept {
  return {.target_limit_s = settings.target_limit_s,
          .joints_limit_s = settings.joints_limit_s,
          .context = {.payload_s = settings.payload_limit_s,
                      .temperature_s = settings.temperature_limit_s,
                      .time_s = settings.time_limit_s},
          .dead_band = settings.dead_band_rad};
}

bool is_sound(const plumb_settings& settings) noexcept {
  const double numbers[] = {settings.target_limit_s,  settings.joints_limit_s,
                            settings.payload_limit_s, settings.temperature_limit_s,
                            settings.time_limit_s,    settings.dead_band_rad};
  return std::all_of(std::begin(numbers), std::end(numbers),
                     [](double x) { return x >= 0.0 && x <= DBL_MAX; });
}

}  // namespace

extern "C" {

plumb_result plumb_settings_init(plumb_settings* settings) {
  const plumb_result found = c::check_pointer(settings);
  if (found != PLUMB_OK) return found;
  *settings = settings_of(CycleSettings{});
  return PLUMB_OK;
}

plumb_result plumb_configure(plumb_robot* robot, const plumb_settings* settings) {
  const plumb_result found = c::first_of(c::check_robot(robot), c::check_struct(settings));
  if (found != PLUMB_OK) return found;
  const plumb_settings asked = c::copy_in(settings);
  if (!is_sound(asked)) return PLUMB_BAD_NUMBER;
  return robot->robot->configure(settings_of(asked)) ? PLUMB_OK : PLUMB_RUNNING;
}

}  // extern "C"
