// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/effects/thermal_growth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "effects/data_rules.hpp"
#include "effects/descriptors.hpp"

namespace plumb::offline {
namespace {

/// Least ranges of temperature that show growth weakly, and clearly. Chosen: over 1 K a metre of
/// steel grows by 12 um, about the noise of a tracker.
constexpr double kWarm_K = 2.0, kWarmer_K = 5.0;
constexpr double kShortest_h = 0.5;             // in which an arm warms up
constexpr double kRoomTemperature_degC = 20.0;  // if no row says its temperature
constexpr double kColdest_degC = -273.15;

constexpr EffectOption kThermalGrowthOptions[] = {
    {.key = OptionKey::kSensor,
     .takes = EffectOption::Takes::kText,
     .rule = "the name of a temperature column",
     .example = "temp"},
    {.key = OptionKey::kReferenceTemperature,
     .rule = "a number above absolute zero",
     .example = "20",
     .above = kColdest_degC,
     .credible_least = -60.0,
     .credible_most = 150.0,
     .credible_help = "the temperature at calibration, in degrees Celsius: kelvin - 273.15"}};

constexpr GridAxis kThermalGrowthGrid[] = {
    {.key = OptionKey::kSensor, .kind = GridAxis::Values::kSensors}};

/// The column of the arm leans as it is warmed from one side.
constexpr EffectParameter kLean[] = {{"lean_x", "rad/K", 5e-6, -1e-3, 1e-3},
                                     {"lean_y", "rad/K", 5e-6, -1e-3, 1e-3}};

Testability thermal_growth_testable(const DataSense& data) {
  if (data.has_temperature) {
    const std::string why =
        fmt::format("{} varies by {:.1f} K", data.temperature, data.temperature_span_K);
    if (data.temperature_span_K >= kWarmer_K) return can_show(why);
    if (data.temperature_span_K > kWarm_K) return can_show_weakly(why);
    return cannot_show(why + ", at one temperature growth is geometry");
  }
  if (data.hours > kShortest_h)
    return can_show_weakly(fmt::format("no temperature, but {:.1f} h of time", data.hours));
  if (data.hours > 0.0)
    return cannot_show(fmt::format(
        "no temperature is recorded, and {:.0f} min are too short to warm up", 60.0 * data.hours));
  return cannot_show("neither temperature nor time is recorded");
}

std::string thermal_sensor(const EffectEntry& entry, const std::vector<std::string>& sensors) {
  if (sensors.empty())
    refuse_effect(entry, "needs a temperature column", "measure temp_degC, or temp_NAME_degC");
  std::string name = text_option(entry, OptionKey::kSensor, sensors.front());
  if (std::find(sensors.begin(), sensors.end(), name) == sensors.end())
    refuse_effect(entry, fmt::format("names sensor '{}'", name),
                  fmt::format("sensors of these files: {}", fmt::join(sensors, ", ")));
  return name;
}

void bind_thermal_growth(const EffectEntry& entry, const ConstantsSource& source,
                         format::Effect& out) {
  const std::string sensor = thermal_sensor(entry, source.sensors());
  const double reference =
      number_option(entry, OptionKey::kReferenceTemperature,
                    source.mean_temperature(sensor).value_or(kRoomTemperature_degC));
  out.constants = {reference};
  out.context = {{format::ContextInput::kTemperature, sensor, reference}};
}

constexpr EffectDescriptor kThermalGrowthDescriptor{
    .name = effects::ThermalGrowth::kInfo.name,
    .law = &effects::ThermalGrowth::kInfo,
    .explanation =
        "Links grow: d_i (1 + alpha dT), with a lag if wanted; steel 12e-6/K, aluminium 23e-6/K. "
        "Needs: temp_NAME_degC, or time. At one temperature it cannot be told from geometry.",
    .options = kThermalGrowthOptions,
    .joints = JointList::kSet,
    .testable = thermal_growth_testable,
    .measure = "the same poses cold and warm, more than 5 K apart, with temp_NAME_degC",
    .sentence = "the links grow with temperature",
    .search = Search::kGrid,
    .candidate_joints = CandidateJoints::kNone,
    .grid = kThermalGrowthGrid,
    .figure = "context-temperature",
    .bind = bind_thermal_growth,
    .arm_parameters = kLean,
};

}  // namespace

const EffectDescriptor& law_descriptor(effects::ThermalGrowth) { return kThermalGrowthDescriptor; }

}  // namespace plumb::offline
