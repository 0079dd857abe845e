// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "plumb/format/model.hpp"

namespace plumb::offline {

/// A chain as URDF: links base_link, link_1 … link_n, tool0; every DH parameter, Hayati's beta and
/// every constant twist becomes part of a joint's origin. Encoder scales cannot be expressed in
/// URDF and are left out. The file has the same forward kinematics as the chain, to rounding.
std::string write_urdf(const std::string& robot, const format::Chain& chain);

}  // namespace plumb::offline
