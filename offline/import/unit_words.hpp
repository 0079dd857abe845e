// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace plumb::offline {

/// The unit that a text means, as plumb writes it: "°", "[mm]", "Millimeter", "grados"; empty if it
/// is none.
std::string known_unit(std::string text);

/// The unit that a text means if it is one that plumb does not convert: "cm", "[ft]"; else empty.
std::string unit_of_others(std::string text);

}  // namespace plumb::offline
