// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace plumb::offline::draw {

/// A short time for people: "210 ns", "2.41 us", "1.5 ms", "3 s".
std::string duration(double ns);

}  // namespace plumb::offline::draw
