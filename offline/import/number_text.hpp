// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace plumb::offline {

/// How a minus and a blank may be written.
inline constexpr std::string_view kMinus[] = {"-", "\u2212", "\u2013", "\uFE63", "\uFF0D"};
inline constexpr std::string_view kBlanks[] = {" ", "\u00A0", "\u202F", "\u2009", "\u2007"};

/// The number that a cell means, with a decimal point, a plain minus and without signs between
/// thousands; its digits are kept. Nothing if the cell is no number. Thousands may be divided by
/// the other of point and comma, an apostrophe, or a blank of any width. A typographic minus is a
/// minus, and 1.5D+03 is 1.5E+03.
std::optional<std::string> plain_number(std::string_view cell, char decimal);

/// Digits with a plain minus and a point: what nearly every cell is.
bool is_plain_number(std::string_view cell);

/// Takes such a number, without a sign, from the front of the text; nothing if none stands there.
std::optional<std::string> take_number(std::string_view& text, char decimal);

/// Its value, if it is finite.
std::optional<double> number_in(std::string_view cell, char decimal);

/// A number and its unit in one cell: "729.06 mm", "54.83°". `number` is the part of the cell.
struct MeasuredCell {
  std::string_view number;
  std::string unit;  // as plumb writes it, or as others do: "cm"
};
std::optional<MeasuredCell> measured_cell(std::string_view cell);

/// Degrees of an angle in degrees, minutes and seconds: 54°49'46.38". With either decimal sign.
std::optional<double> sexagesimal(std::string_view cell);

}  // namespace plumb::offline
