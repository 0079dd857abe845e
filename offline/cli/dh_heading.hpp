// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace plumb::offline::cli {

/// A heading of a DH table: "alpha_deg", "α [°]", "theta (rad)", "a_{i-1} / mm", "Joint".
struct DhHeading {
  std::string name = {};      // "alpha"; empty for a column that no DH table has
  std::string unit = {};      // as plumb writes it: "deg"; empty if none is written
  std::string bad_unit = {};  // what is written in its place and is no unit of plumb: "cm"
};

DhHeading read_dh_heading(std::string_view header);

}  // namespace plumb::offline::cli
