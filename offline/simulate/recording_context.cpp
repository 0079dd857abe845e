// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "simulate/recording.hpp"

/// The context columns that are written with the measured points.
namespace plumb::offline::sim {
namespace {

constexpr double kZero_degC = 20.0;
constexpr double kSensor_K = 0.03;   // 1 sigma
constexpr double kDisplay_K = 0.01;  // resolution

Column number_column(const std::string& name, const std::string& unit, Quantity quantity) {
  Column column;
  column.header = unit.empty() ? name : name + "_" + unit;
  column.name = name;
  column.unit = unit;
  column.quantity = quantity;
  return column;
}

bool needs(const std::vector<HiddenEffect>& effects, LawEntry::Needs what) {
  return std::any_of(effects.begin(), effects.end(), [&](const HiddenEffect& effect) {
    return find_law(effect.name)->needs == what;
  });
}

bool is_recorded(Recorded asked, bool needed) {
  return asked == Recorded::kAlways || (asked == Recorded::kIfNeeded && needed);
}

template <class Value>
void add_column(std::vector<Column>& columns, Column column, const std::vector<Visit>& visits,
                Value value) {
  for (const auto& visit : visits) column.values.push_back(value(visit));
  columns.push_back(std::move(column));
}

void add_payloads(std::vector<Column>& out, const std::vector<Visit>& visits) {
  add_column(out, number_column("payload", "kg", Quantity::kMass), visits,
             [](const Visit& visit) { return visit.payload.mass_kg; });
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string name = std::string("payload_c") + "xyz"[k];
    add_column(out, number_column(name, "mm", Quantity::kLength), visits,
               [k](const Visit& visit) { return visit.payload.com_m[k]; });
  }
}

}  // namespace

// Adds the readings of the temperature sensors. They are at other places than the zones, lag behind
// them, and are noisy.
void Recording::add_temperatures(std::vector<Column>& out, const std::vector<Visit>& visits) const {
  Random random(plan_.seed, "temperature noise");
  const int n = cell_.joints();
  const auto add = [&](const std::string& name, auto kelvin) {
    add_column(out, number_column(name, "degC", Quantity::kTemperature), visits,
               [&](const Visit& visit) {
                 const double T = kZero_degC + kelvin(visit) + kSensor_K * random.normal();
                 return std::round(T / kDisplay_K) * kDisplay_K;
               });
  };
  const int shoulder = std::min(2, n), elbow = std::min(3, n);
  add("temp", [&](const Visit& visit) {
    return 0.6 * visit.zone_K(shoulder) + 0.3 * visit.zone_K(std::min(1, n)) + 0.1 * visit.room_K;
  });
  add("temp_room", [](const Visit& visit) { return visit.room_K; });
  add("temp_elbow",
      [&](const Visit& visit) { return 0.8 * visit.zone_K(elbow) + 0.2 * visit.room_K; });
}

void Recording::add_directions(std::vector<Column>& out, const std::vector<Visit>& visits) const {
  for (int j = 0; j < cell_.joints(); ++j) {
    const bool slides =
        cell_.nominal.joints[static_cast<std::size_t>(j)].type == format::JointType::kPrismatic;
    const std::string joint = "j" + std::to_string(j + 1);
    add_column(out, number_column("dir_" + joint, "", Quantity::kNumber), visits,
               [j](const Visit& visit) { return visit.direction(j); });
    add_column(out,
               number_column("travel_" + joint, slides ? "mm" : "deg",
                             slides ? Quantity::kLength : Quantity::kAngle),
               visits, [j](const Visit& visit) { return visit.travel(j); });
  }
}

std::vector<Column> Recording::context(const std::vector<Visit>& visits) const {
  std::vector<Column> out;
  add_column(out, number_column("t", "s", Quantity::kTime), visits,
             [](const Visit& visit) { return visit.time_s; });
  if (is_recorded(plan_.directions, needs(effects_, LawEntry::Needs::kDirection))) {
    add_directions(out, visits);
  }
  if (!plan_.payloads.empty()) add_payloads(out, visits);
  if (is_recorded(plan_.temperatures, needs(effects_, LawEntry::Needs::kTemperature))) {
    add_temperatures(out, visits);
  }
  return out;
}

}  // namespace plumb::offline::sim
