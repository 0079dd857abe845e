// SPDX-License-Identifier: Apache-2.0
#include "twin/surroundings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "simulate/law.hpp"

namespace plumb::offline::twin {
namespace {

using Domain = sim::LawEntry::Domain;

constexpr double kHours_s = 7200.0;

/// The hidden effects without those that act on the measurement only.
HiddenTruth of_the_arm(HiddenTruth truth) {
  std::erase_if(truth.sized, [](const HiddenEffect& effect) {
    const Domain domain = sim::find_law(effect.name)->domain;
    return domain != Domain::kRobot && domain != Domain::kEnvironment;
  });
  return truth;
}

const Column* find(const Simulation& seen, const std::string& name) {
  const auto found = std::find_if(seen.context.begin(), seen.context.end(),
                                  [&](const Column& column) { return column.name == name; });
  return found == seen.context.end() ? nullptr : &*found;
}

const Column& sensor(const Simulation& seen, const std::string& name) {
  const Column* const found = find(seen, name);
  if (found != nullptr && found->quantity == Quantity::kTemperature) return *found;
  std::vector<std::string> names;
  for (const Column& column : seen.context)
    if (column.quantity == Quantity::kTemperature) names.push_back(column.name);
  throw Failure(
      Exit::kInput,
      {.code = "E-TWIN-SENSOR",
       .message = fmt::format("twin.toml names the sensor '{}', which the arm has not", name),
       .help = fmt::format("[controller] temperatures = [\"{}\"]", fmt::join(names, "\", \""))});
}

double value_of(const std::string& name, const Readings& now) {
  if (name == "payload") return now.payload.mass_kg;
  if (name == "com_x") return now.payload.com_m[0];
  if (name == "com_y") return now.payload.com_m[1];
  if (name == "com_z") return now.payload.com_m[2];
  if (name == "time") return now.time_s;
  for (std::size_t k = 0; k < now.temperatures.size(); ++k)
    if (name == now.temperatures[k].sensor || name == fmt::format("t{}", k + 1))
      return now.temperatures[k].degC;
  return std::nan("");
}

}  // namespace

SimulationPlan visits_of(const HiddenTruth& truth, const RowsN& q, int stations) {
  SimulationPlan plan;
  plan.q = q;
  plan.noise_m = 0.0;
  plan.seconds_per_pose = kHours_s / stations;
  plan.session_s = kHours_s;
  plan.temperatures = Recorded::kAlways;
  plan.seed = truth.seed.value_or(1);
  plan.truth = of_the_arm(truth);
  return plan;
}

std::vector<Readings> readings_along(const Cell& cell, const Hidden& hidden,
                                     const HiddenTruth& truth, const Path& path) {
  const Simulation seen = simulate(cell, visits_of(truth, path.q, path.stations()));
  const Column& time = *find(seen, "t");
  std::vector<Readings> out;
  for (int k = 0; k < path.stations(); ++k) {
    const auto row = static_cast<std::size_t>(k);
    Readings now{.payload = cell.payload, .time_s = time.values[row], .temperatures = {}};
    for (const auto& name : hidden.sensors)
      now.temperatures.push_back({name, sensor(seen, name).values[row]});
    out.push_back(std::move(now));
  }
  return out;
}

drivers::BusMessage context_message(const drivers::MessageLayout& layout, const Readings& now,
                                    std::uint16_t counter) {
  drivers::BusMessage out;
  out.kind = drivers::MessageKind::kContext;
  out.size = static_cast<std::uint8_t>(layout.signals.size());
  out.counter = counter;
  for (std::size_t i = 0; i < layout.signals.size(); ++i)
    out.values[i] = value_of(layout.signals[i].name, now);
  return out;
}

bool needs_temperatures(const std::vector<HiddenEffect>& effects) {
  return std::any_of(effects.begin(), effects.end(), [](const HiddenEffect& effect) {
    return sim::find_law(effect.name)->needs == sim::LawEntry::Needs::kTemperature;
  });
}

}  // namespace plumb::offline::twin
