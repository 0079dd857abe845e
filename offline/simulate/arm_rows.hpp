// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cell/cell.hpp"

namespace plumb::offline::sim {

/// A DH row in the units of data sheets, [mm] and [deg]. The limits of q are in [deg], or in [mm]
/// for a sliding joint.
struct SheetRow {
  double alpha_deg = 0.0;
  double a_mm = 0.0;
  double d_mm = 0.0;
  double theta_deg = 0.0;
  double q_min = -180.0;
  double q_max = 180.0;
  format::JointType type = format::JointType::kRevolute;
  bool parallel_next = false;
};

/// A cell with joints J1, J2, ... and a tool along z of the flange. Frame and target are fitted,
/// sigma is 10 um, and geometry is the only effect.
Cell cell_from_sheet(format::Convention convention, const std::vector<SheetRow>& rows,
                     double tool_mm);

}  // namespace plumb::offline::sim
