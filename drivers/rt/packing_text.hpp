// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "plumb/drivers/bus_layout.hpp"
#include "plumb/drivers/bus_port.hpp"

namespace plumb::drivers::rt {

/// How the controller packs its messages otherwise than the layout says, and what is to be done
/// about it; empty: it does not.
std::string packing_text(const RegisterPacking& packing, const BusLayout& layout);

}  // namespace plumb::drivers::rt
