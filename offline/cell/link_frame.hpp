// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/format/model.hpp"
#include "plumb/runtime/transform.hpp"

namespace plumb::offline {

/// The frame that data sheets and dynamics files give centres of mass in, the Denavit-Hartenberg
/// frame of link `joint` (zero-based), as a pose in the frame that moves with the joint: behind its
/// rotation, ahead of its Tz(d). Nominal geometry, [m]. Precondition: 0 <= joint < joints.
Transformd link_frame(const format::Chain& nominal, int joint);

/// How far a point is from the line between the joint and the next one [m]. `point_P` is in the
/// frame that moves with the joint. Precondition: it is not the last joint.
double distance_from_link(const format::Chain& nominal, int joint, const Vector3& point_P);

/// Length of the stretched arm from base to flange [m]: the links' |a| and |d| added up, sliding
/// joints as in the table.
double stretched_length(const format::Chain& nominal);

/// How far beside that line a centre of mass may be [m]: a third of the link's length, or 15 % of
/// the length of the stretched arm if that is more, as for the short links of a wrist.
/// Precondition: it is not the last joint.
double widest_link(const format::Chain& nominal, int joint);

}  // namespace plumb::offline
