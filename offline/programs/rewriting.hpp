// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "programs/languages.hpp"

namespace plumb::offline::programs {

/// Decimals of the numbers of a program's targets: the most that any of them has, because
/// controllers leave zeros at the end out.
struct Decimals {
  int position = 0, orientation = 0;
};
Decimals decimals_of(const Program& program, int least_mm);

/// New digits for the bytes of one number.
struct Edit {
  Number number;
  std::string digits;
};

/// The edits that write `values` in the place of a target's numbers, and what is then written.
/// A number whose digits would mean the same stays as it is.
struct NewDigits {
  std::vector<Edit> edits;
  std::vector<double> written;
};
NewDigits new_digits(const Program& program, const Target& target,
                     const std::vector<double>& values, const Decimals& decimals);

/// The files of the program with these edits; the same bytes where there are none.
std::vector<std::string> edited(const Program& program, std::vector<Edit> edits);

/// The lines that say that a program was filtered, and with what; written into a file at the place
/// its language has for them, with the ends of line that the file has.
struct Mark {
  std::string model, sha256;
};
std::string marked(const Language& language, std::string_view bytes, const Mark& mark);

/// The line of such a mark, from 1; 0 if there is none.
int line_of_mark(std::string_view bytes);

/// The lines that differ, as `diff -u` prints them. `after` has all lines of `before`, some
/// changed, and may have others put in between.
std::string unified_diff(const std::string& file, std::string_view before, std::string_view after);

}  // namespace plumb::offline::programs
