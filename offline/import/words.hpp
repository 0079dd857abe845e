// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace plumb::offline {

/// What the words of a column's name say. Words of English, German, French, Italian, Spanish,
/// Chinese and Japanese are known; case, accents, blanks and signs do not count.
struct NamedColumn {
  std::string name;              // canonical: "q1", "x", "temp", "date"; empty: not understood
  std::string stem;              // of a numbered name, without the number: "actualq"
  int number = -1;               // of a joint or of a part of a quaternion, as written
  bool letter_q = false;         // "Q1": a joint, or a part of a quaternion
  bool quaternion_part = false;  // "Quaternion 1": name is empty, number says which
  bool uncertain = false;        // "Uncertainty X": name is "sx", the number of sigma unknown
};

NamedColumn named_column(std::string_view header);

/// Lower case, accents folded ("É" is "e"), without blanks and signs; "µ" is "u", "σ" is "sigma".
std::string folded(std::string_view text);

}  // namespace plumb::offline
