// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace plumb::offline {

/// Which columns must be there.
enum class Needs { kJoints, kJointsAndPosition };

}  // namespace plumb::offline
