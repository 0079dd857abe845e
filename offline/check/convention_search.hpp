// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "check/interpretation.hpp"

namespace plumb::offline {

/// What the convention search found.
struct Detection {
  Interpretation present;             // as labelled
  Interpretation best;                // the same unless another fits clearly better
  std::vector<Interpretation> table;  // best first, the present one included
  std::vector<Interpretation> same;   // others that predict the same points as the best
  long tried = 0;
  std::string why_not;                      // why nothing was tried: too few poses, …
  std::string help = "measure more poses";  // and what to do about it
  bool changed = false;
};

/// Tries how the files may be meant: DH convention, units of table and columns, the direction of
/// each joint (all 2^n), left-handed coordinates; if nothing of that fits, zeros turned by 90 or
/// 180 deg at up to two joints; and then, from 20 poses on, the columns of turning joints in
/// another order (all of six joints; of more, swaps and neighbours in turn); and last zeros of any
/// angle, and one column alone in another unit or scale (joint_maps). The labels are kept
/// unless another interpretation leaves less than a tenth and the present one is not reasonable.
/// Deterministic. Of several set-ups it looks at the one with the most rows.
///
/// Cost: about 10 us an interpretation on 40 poses, 5 to 50 ms in all, a second for other orders.
/// Throws Failure as parse_cell.
Detection detect_convention(const Cell& cell, const MeasurementFiles& measured);

}  // namespace plumb::offline
