// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "tests/cases/artefact_readings.hpp"

namespace plumb::offline {

/// How the arms of one line of the table were measured.
struct SocketWay {
  enum class Kind { kSockets, kKnownDistance, kTracker, kArtefacts } kind = Kind::kSockets;
  int readings = 100;      // of ten sockets, on five places; poses that a tracker measured; or of
                           // five artefacts of the kind `artefacts`
  double sigma_m = 30e-6;  // play of the ball, or noise of the tracker, each axis; or of a reading
  ArtefactPlan::Kind artefacts = ArtefactPlan::Kind::kPlane;
};

/// What came out for one way, over some arms.
struct SocketMarks {
  SocketWay way;
  std::vector<double> errors_m;  // of each arm: mean at fresh joints, the base laid on the true one
  int inside = 0, numbers = 0;   // numbers of the arm within their 95 % interval, and all
  int refused = 0;               // arms that were not calibrated

  double mean_m() const;
  double inside_share() const { return numbers > 0 ? static_cast<double>(inside) / numbers : 0.0; }
};

/// What the arm of one way touches, and what the way is called.
SocketPlan plan_of(const SocketWay& way, std::uint64_t seed);
std::string name_of(const SocketWay& way);

/// The cell of that arm with the sigma of the way, and its readings.
struct SocketCell {
  Cell cell;
  MeasurementFiles measured;
};
SocketCell read_way(SocketArm& arm, const SocketWay& way);

/// Calibrates `arms` arms, seeds from `seed` on.
SocketMarks socket_marks(const SocketWay& way, int arms, std::uint64_t seed);

/// The table of docs/without-a-tracker.md.
std::string socket_table(const std::vector<SocketMarks>& all);

}  // namespace plumb::offline
