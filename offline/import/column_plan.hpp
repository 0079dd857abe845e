// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "import/words.hpp"

namespace plumb::offline {

/// What a foreign column becomes.
struct ColumnPlan {
  std::string from;       // as in the file
  std::string name = {};  // canonical, without unit: "q1", "x", "temp", "pose"; empty: left out
  std::string unit = {};  // of the file's numbers: "rad"; empty for texts and plain numbers
  bool wished = false;    // the user named it with --map
  bool lacks_unit = false;
  std::string foreign = {};         // a unit that plumb does not convert: "cm"
  double divisor = 1.0;             // of the numbers: 2 for an expanded uncertainty
  std::string said = {};            // the words that state the divisor: "U(95)"
  std::string uncertain_unit = {};  // of an uncertainty that is left out, if its name states one
  NamedColumn named = {};           // the meaning of the words of its name
};

}  // namespace plumb::offline
