// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace plumb::offline {

/// What the columns and poses of some measurements could show. SI; vectors have one entry per
/// joint.
struct DataSense {
  int poses = 0;                    // distinct ones
  bool ordered = false;             // rows are known to be in the order of measuring
  double hours = 0.0;               // from first to last row; 0: no time
  double payload_span_kg = 0.0;     // largest less smallest
  double temperature_span_K = 0.0;  // of the temperature that varies most
  std::string temperature;          // and its column
  bool has_temperature = false;
  bool has_wrench = false;         // force or torque columns
  bool has_masses = false;         // of links, in the cell
  bool has_payload = false;        // in the cell or as a column
  double noise_m = 0.0;            // 1 sigma per axis, 0 unknown
  int revisits = 0;                // poses measured again later than as an immediate repeat
  bool positions = true;           // measured, not points that the tool touches
  bool tracker_frame = false;      // the origin of the coordinates is the instrument
  std::vector<std::string> names;  // of the joints
  std::vector<bool> turns;         // a turning joint
  std::vector<double> range;       // used by the poses [rad] or [m]
  std::vector<double> both_ways;   // share of the rarer approach direction, 0 .. 0.5; -1 unknown
  std::vector<bool> has_travel;
  std::vector<bool> has_gear_ratio;
  std::vector<double> lever_m;  // span over the poses of the gravity torque of 1 kg at the tool,
                                // over its weight: 0 where gravity never turns the joint
  int joints() const { return static_cast<int>(range.size()); }
};

}  // namespace plumb::offline
