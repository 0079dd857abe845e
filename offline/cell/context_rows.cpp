// SPDX-License-Identifier: Apache-2.0
#include "cell/context_rows.hpp"

#include <algorithm>
#include <cmath>

namespace plumb::offline {

namespace {

RowsN picked(const RowsN& all, const std::vector<int>& rows) {
  if (all.rows() == 0) return {};
  return all(rows, Eigen::all);
}

Eigen::VectorXd picked(const Eigen::VectorXd& all, const std::vector<int>& rows) {
  if (all.size() == 0) return {};
  return all(rows);
}

template <class To>
void copy_row(const RowsN& from, Eigen::Index row, To& to) {
  if (from.rows() == 0) return;
  const auto n = std::min(static_cast<std::size_t>(from.cols()), to.size());
  for (std::size_t k = 0; k < n; ++k) to[k] = from(row, static_cast<Eigen::Index>(k));
}

}  // namespace

ContextRows pick(const ContextRows& all, const std::vector<int>& rows) {
  return {.direction = picked(all.direction, rows),
          .travel = picked(all.travel, rows),
          .step = picked(all.step, rows),
          .payload = picked(all.payload, rows),
          .wrench = picked(all.wrench, rows),
          .temperature = picked(all.temperature, rows),
          .sensors = all.sensors,
          .time_s = picked(all.time_s, rows),
          .order = picked(all.order, rows)};
}

MeasuredContext context_at(const ContextRows& rows, Eigen::Index row,
                           const std::vector<std::string>& sensors) {
  MeasuredContext out;
  Context& known = out.known;
  copy_row(rows.direction, row, known.direction);
  copy_row(rows.travel, row, known.travel);
  copy_row(rows.step, row, out.step);
  if (rows.payload.rows() > 0) {
    known.payload_kg = rows.payload(row, 0);
    for (int k = 0; k < 3; ++k) known.payload_com_m[k] = rows.payload(row, 1 + k);
  }
  if (rows.wrench.rows() > 0)
    for (int k = 0; k < 3; ++k) {
      known.force_N[k] = std::isnan(rows.wrench(row, k)) ? 0.0 : rows.wrench(row, k);
      known.moment_Nm[k] = std::isnan(rows.wrench(row, 3 + k)) ? 0.0 : rows.wrench(row, 3 + k);
    }
  for (std::size_t k = 0; k < std::min(sensors.size(), known.temperature_degC.size()); ++k) {
    const auto at = std::find(rows.sensors.begin(), rows.sensors.end(), sensors[k]);
    if (at != rows.sensors.end())
      known.temperature_degC[k] = rows.temperature(row, at - rows.sensors.begin());
  }
  if (rows.time_s.size() > 0) known.time_s = rows.time_s(row);
  if (rows.order.size() > 0) out.order = rows.order(row);
  return out;
}

}  // namespace plumb::offline
