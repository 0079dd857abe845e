// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

namespace plumb::offline {

using Cells = std::vector<std::string_view>;

/// Whether a separator between brackets, as in "U(x) [mm; k=2]", divides cells too.
enum class Brackets { kCut, kKeptWhole };

/// The cells of a line, without the quotes around them; ' ' stands for any run of blanks. A quote
/// counts only at the beginning of a cell, for it also stands for inches and for seconds of arc.
Cells cut_line(std::string_view line, char separator, Brackets brackets = Brackets::kCut);

/// Several numbers in one cell, between brackets: "[0.1, 0.2, 0.3]"; none if the cell is no vector.
Cells vector_parts(std::string_view cell);

/// A line that begins with a sign for comments; the line without the sign.
bool is_comment(std::string_view line);
std::string_view without_comment_sign(std::string_view line);

/// A number in any way of writing, with a unit or without.
bool is_number(std::string_view cell);

/// "16:57", "20.10.2022 16:57": no number, but no name of a column either.
bool is_time(std::string_view cell);

/// The share of the cells that hold numbers or times; empty cells at the end do not count.
double number_share(Cells cells);

}  // namespace plumb::offline
