// SPDX-License-Identifier: Apache-2.0
#include "check/data_sense.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "noise/noise_floor.hpp"
#include "plumb/runtime/chain.hpp"

namespace plumb::offline {
namespace {

/// Smallest and largest value of a column over the files; empty if one lacks it.
struct Span {
  double low = 0.0, high = 0.0;
  bool known = false;
  double size() const { return known ? high - low : 0.0; }
};

Span span_of(const MeasurementFiles& measured, const std::string& name) {
  Span out;
  for (const auto& table : measured.tables) {
    const Column* column = table.find(name);
    if (column == nullptr || column->values.empty()) return {};
    const auto [low, high] = std::minmax_element(column->values.begin(), column->values.end());
    out.low = out.known ? std::min(out.low, *low) : *low;
    out.high = out.known ? std::max(out.high, *high) : *high;
    out.known = true;
  }
  return out;
}

void sense_temperatures(const MeasurementFiles& measured, DataSense& out) {
  if (measured.tables.empty()) return;
  for (const auto& column : measured.tables.front().columns) {
    if (column.quantity != Quantity::kTemperature) continue;
    const double size = span_of(measured, column.name).size();
    if (out.has_temperature && size <= out.temperature_span_K) continue;
    out.has_temperature = true;
    out.temperature_span_K = size;
    out.temperature = column.header;
  }
}

bool any_column(const MeasurementFiles& measured, Quantity quantity) {
  for (const auto& table : measured.tables)
    for (const auto& column : table.columns)
      if (column.quantity == quantity) return true;
  return false;
}

double share_of_rarer_direction(const MeasurementFiles& measured, int joint) {
  int plus = 0, minus = 0;
  for (const auto& table : measured.tables) {
    const Column* column = table.find(fmt::format("dir_j{}", joint + 1));
    if (column == nullptr) return -1.0;
    for (const double d : column->values) (d > 0 ? plus : minus) += d != 0.0 ? 1 : 0;
  }
  const int all = plus + minus;
  return all > 0 ? static_cast<double>(std::min(plus, minus)) / all : 0.0;
}

bool has_column(const MeasurementFiles& measured, const std::string& name) {
  return !measured.tables.empty() &&
         std::all_of(measured.tables.begin(), measured.tables.end(),
                     [&](const Table& table) { return table.find(name) != nullptr; });
}

int revisits(const Measurements& measured, const std::vector<int>& rows) {
  std::set<int> seen;
  int out = 0, before = -1;
  for (const int i : rows) {
    const int group = measured.replicate_group[i];
    if (group != before && !seen.insert(group).second) ++out;
    before = group;
  }
  return out;
}

/// Finds for each joint the range over the poses of the lever arm of gravity for a mass at the
/// tool, z_j . ((c - o_j) x g) / |g| [m].
void sense_levers(const Cell& cell, const Measurements& measured, const std::vector<int>& rows,
                  DataSense& out) {
  const Vector3 g(cell.gravity[0], cell.gravity[1], cell.gravity[2]);
  std::vector<double> low(cell.joints(), 1e300), high(cell.joints(), -1e300);
  out.lever_m.assign(cell.joints(), 0.0);
  if (!(g.norm() > 0.0)) return;
  const Chain chain(cell.nominal);
  ChainFrames frames;
  for (const int i : rows) {
    const auto q = measured.q.row(i);
    chain.frames({q.data(), static_cast<std::size_t>(q.cols())}, frames);
    for (int j = 0; j < cell.joints(); ++j) {
      const Vector3 z = frames.joint[j].R.col(2);
      const double lever = z.dot((frames.tip.p - frames.joint[j].p).cross(g)) / g.norm();
      low[j] = std::min(low[j], lever);
      high[j] = std::max(high[j], lever);
    }
  }
  for (int j = 0; j < cell.joints(); ++j)
    if (out.turns[j]) out.lever_m[j] = high[j] - low[j];
}

}  // namespace

DataSense data_sense(const Cell& cell, const MeasurementFiles& measured,
                     const std::vector<int>& rows) {
  DataSense out;
  std::set<int> groups;
  for (const int i : rows) groups.insert(measured.replicate_group[i]);
  out.poses = static_cast<int>(groups.size());
  const Eigen::VectorXd& time_s = measured.context.time_s;  // of t_s or of a column time
  if (time_s.size() > 0) out.hours = (time_s.maxCoeff() - time_s.minCoeff()) / 3600.0;
  out.ordered = time_s.size() > 0;
  out.payload_span_kg = span_of(measured, "payload").size();
  out.has_payload = cell.payload.mass_kg > 0.0 || span_of(measured, "payload").known;
  sense_temperatures(measured, out);
  out.has_wrench =
      any_column(measured, Quantity::kForce) || any_column(measured, Quantity::kTorque);
  out.noise_m = noise_floor(cell, measured).sigma_m;
  out.revisits = revisits(measured, rows);
  out.positions = measured.placement.empty() || std::any_of(rows.begin(), rows.end(), [&](int row) {
                    return !measured.of_artefact(row);
                  });
  for (const auto& table : measured.tables)
    for (const auto& [key, value] : table.comments)
      out.tracker_frame = out.tracker_frame || (key == "frame" && value == "tracker");
  for (int j = 0; j < cell.joints(); ++j) {
    out.names.push_back(cell.nominal.joints[j].name);
    out.turns.push_back(cell.nominal.joints[j].type == format::JointType::kRevolute);
    double low = 1e300, high = -1e300;
    for (const int i : rows) {
      low = std::min(low, measured.q(i, j));
      high = std::max(high, measured.q(i, j));
    }
    out.range.push_back(high - low);
    out.both_ways.push_back(share_of_rarer_direction(measured, j));
    out.has_travel.push_back(has_column(measured, fmt::format("travel_j{}", j + 1)));
    const bool known = j < static_cast<int>(cell.mechanics.size());
    out.has_gear_ratio.push_back(known && cell.mechanics[j].gear_ratio.has_value());
    out.has_masses = out.has_masses || (known && cell.mechanics[j].has_mass());
    out.ordered = out.ordered || out.both_ways.back() >= 0.0;
  }
  sense_levers(cell, measured, rows, out);
  return out;
}

}  // namespace plumb::offline
