// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "plumb/format/model.hpp"
#include "programs/program.hpp"

namespace plumb::offline::cli {

/// The frames of an option that is given as NAME=X,Y,Z,RX,RY,RZ (mm; deg about fixed axes, as `rpy`
/// in cell.toml) or NAME=X,Y,Z,QW,QX,QY,QZ, and for a tool also as NAME=model. Names in lower case.
/// `model_tool`: null where there is none. Throws Failure (kUsage).
programs::Frames given_frames(const std::string& option, const std::vector<std::string>& words,
                              const format::Pose* model_tool);

}  // namespace plumb::offline::cli
