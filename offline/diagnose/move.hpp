// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace plumb::offline {

/// One of several moves of a set-up during a measurement.
struct Move {
  double after_row = 0.0;  // the last row before it, from 1
  double size_m = 0.0;     // RMS motion of the measured point at the poses behind it
};

}  // namespace plumb::offline
