// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "cell/cell.hpp"

namespace plumb::offline {

/// What is stated of one measured pose instead of being drawn. SI.
struct StatedVisit {
  std::optional<Payload> payload;   // carried there
  std::optional<double> time_s;     // when it is measured
  std::optional<double> running_s;  // since the drives were switched on, for the temperatures; the
                                    // time if it is not given
};

}  // namespace plumb::offline
