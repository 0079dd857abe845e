// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace plumb::offline::cli {

/// A cell of a DH table as people write it: "-612", "pi/2", "-90°", "0.5*pi", "q2 - 90", "118 mm".
struct DhValue {
  double value = 0.0;     // in `unit`, without the joint's variable
  std::string unit = {};  // written in the cell ("deg"), or "rad" of a multiple of pi; else empty
  bool of_pi = false;     // the number pi stands in it
  bool variable = false;  // the joint's own variable is added: q2, theta_2, θ2
  int of_joint = 0;       // the number behind the variable, from 1; 0 if there is none
};

/// Nothing if the text is no such value. With `comma`, a comma is a decimal sign.
std::optional<DhValue> read_dh_value(std::string_view text, bool comma);

}  // namespace plumb::offline::cli
