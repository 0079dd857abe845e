// SPDX-License-Identifier: Apache-2.0
#include "simulate/visit.hpp"

#include <cmath>
#include <string>

namespace plumb::offline::sim {

std::vector<Visit> drive(const RowsN& q, const VectorXd& start, double seconds_per_pose) {
  std::vector<Visit> visits;
  visits.reserve(static_cast<std::size_t>(q.rows()));
  Visit now;
  now.q = now.before = start;
  now.direction = now.travel = VectorXd::Zero(start.size());
  now.zone_K = VectorXd::Zero(start.size() + 1);
  for (int row = 0; row < q.rows(); ++row) {
    now.time_s = now.running_s = row * seconds_per_pose;
    const VectorXd step = q.row(row).transpose() - now.q;
    if (!step.isZero(0.0)) now.before = now.q;
    for (int j = 0; j < start.size(); ++j) {
      if (step(j) == 0.0) continue;
      now.direction(j) = step(j) > 0.0 ? 1.0 : -1.0;
      now.travel(j) = std::abs(step(j));
    }
    now.q = q.row(row).transpose();
    visits.push_back(now);
  }
  return visits;
}

void put_stated(const std::vector<StatedVisit>& stated, std::vector<Visit>& visits) {
  if (stated.empty()) return;
  if (stated.size() != visits.size())
    throw Failure(Exit::kUsage,
                  {Severity::kError, "E-SIM-PLAN",
                   "payload and time are stated for " + std::to_string(stated.size()) +
                       " rows, but " + std::to_string(visits.size()) + " are measured",
                   std::nullopt, "state them for every row, or for none"});
  for (std::size_t row = 0; row < visits.size(); ++row) {
    Visit& visit = visits[row];
    if (stated[row].payload) visit.payload = *stated[row].payload;
    if (stated[row].time_s) visit.time_s = visit.running_s = *stated[row].time_s;
    if (stated[row].running_s) visit.running_s = *stated[row].running_s;
  }
}

}  // namespace plumb::offline::sim
