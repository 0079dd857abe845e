// SPDX-License-Identifier: Apache-2.0
#include "import/number_text.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <span>

#include "import/unit_words.hpp"
#include "program/utf8.hpp"

namespace plumb::offline {
namespace {

using Signs = std::span<const std::string_view>;

constexpr std::string_view kApostrophes[] = {"'", "\u2019"};
constexpr std::string_view kPlus[] = {"+"};
constexpr std::string_view kExponent[] = {"e", "E", "d", "D"};
constexpr std::string_view kDegree[] = {"\u00B0", "\u00BA"};
constexpr std::string_view kMinute[] = {"'", "\u2032", "\u2019"};
constexpr std::string_view kSecond[] = {"\"\"", "\"", "\u2033", "\u201D", "''"};

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// Takes one of the signs from the front; the sign, or nothing.
std::string_view take(std::string_view& text, Signs signs) {
  for (const auto sign : signs)
    if (text.starts_with(sign)) {
      text.remove_prefix(sign.size());
      return sign;
    }
  return {};
}

std::string_view digits(std::string_view& text) {
  std::size_t n = 0;
  while (n < text.size() && is_digit(text[n])) ++n;
  const auto out = text.substr(0, n);
  text.remove_prefix(n);
  return out;
}

std::string_view without_blanks(std::string_view text) {
  text = trimmed(text);
  while (!take(text, kBlanks).empty()) {
  }
  for (bool again = true; again;) {
    again = false;
    for (const auto blank : kBlanks)
      if (text.ends_with(blank)) text.remove_suffix(blank.size()), again = true;
  }
  return text;
}

/// "1'234'567" without its signs; "123" as it is. All signs are alike, all groups but the first
/// have three digits, and a number of several groups does not begin with 0.
std::optional<std::string> whole_part(std::string_view& text, char decimal) {
  std::string out(digits(text));
  const std::size_t first = out.size();
  std::string_view sign;
  const std::string_view other[] = {decimal == ',' ? "." : ","};
  for (;;) {
    std::string_view rest = text;
    std::string_view found = take(rest, other);
    if (found.empty()) found = take(rest, kApostrophes);
    if (found.empty()) found = take(rest, kBlanks);
    if (found.empty()) return out;
    const auto group = digits(rest);
    const bool fits = group.size() == 3 && first >= 1 && first <= 3 && out.front() != '0' &&
                      (sign.empty() || sign == found);
    if (!fits) return std::nullopt;
    sign = found;
    out += group;
    text = rest;
  }
}

std::string_view value_before(std::string_view cell) {
  std::size_t end = cell.size();
  while (end > 0 && !is_digit(cell[end - 1]) && cell[end - 1] != '.') --end;
  return cell.substr(0, end);
}

std::optional<double> part(std::string_view& text) {
  std::string number(digits(text));
  if (text.starts_with('.') || text.starts_with(',')) {
    text.remove_prefix(1);
    number += '.';
    number += digits(text);
  }
  return number_in(number, '.');
}

}  // namespace

bool is_plain_number(std::string_view cell) {
  if (cell.starts_with('-')) cell.remove_prefix(1);
  if (cell.empty() || !is_digit(cell.front()) || !is_digit(cell.back())) return false;
  int points = 0;
  for (const char c : cell) {
    points += c == '.' ? 1 : 0;
    if (!is_digit(c) && c != '.') return false;
  }
  return points <= 1;
}

std::optional<std::string> take_number(std::string_view& text, char decimal) {
  const auto whole = whole_part(text, decimal);
  if (!whole) return std::nullopt;
  std::string out = *whole;
  bool any = !whole->empty();
  if (text.starts_with(decimal)) {
    text.remove_prefix(1);
    const auto behind = digits(text);
    any = any || !behind.empty();
    out += '.';
    out += behind;
  }
  if (!any) return std::nullopt;
  std::string_view rest = text;  // "90deg" has no exponent
  if (const auto letter = take(rest, kExponent); !letter.empty()) {
    const bool minus = !take(rest, kMinus).empty();
    const bool plus = !minus && !take(rest, kPlus).empty();
    if (const auto exponent = digits(rest); !exponent.empty()) {
      (out += letter == "e" ? 'e' : 'E') += minus ? "-" : plus ? "+" : "";
      out += exponent;
      text = rest;
    }
  }
  return out;
}

std::optional<std::string> plain_number(std::string_view cell, char decimal) {
  if (decimal == '.' && is_plain_number(cell)) return std::string(cell);
  cell = without_blanks(cell);
  const bool minus = !take(cell, kMinus).empty();
  if (!minus) (void)take(cell, kPlus);
  const auto number = take_number(cell, decimal);
  if (!number || !cell.empty()) return std::nullopt;
  return (minus ? "-" : "") + *number;
}

std::optional<double> number_in(std::string_view cell, char decimal) {
  std::optional<std::string> text;
  if (decimal != '.' || !is_plain_number(cell)) {
    text = plain_number(cell, decimal);
    if (!text) return std::nullopt;
    cell = *text;
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc{} || end != cell.data() + cell.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

std::optional<MeasuredCell> measured_cell(std::string_view cell) {
  if (cell.empty() || is_digit(cell.back())) return std::nullopt;
  cell = without_blanks(cell);
  const auto before = value_before(cell);
  if (before.empty() || before.size() == cell.size()) return std::nullopt;
  const std::string behind(without_blanks(cell.substr(before.size())));
  if (behind.find_first_of("[](){}") != behind.npos) return std::nullopt;
  std::string unit = known_unit(behind);
  if (unit.empty()) unit = unit_of_others(behind);
  if (unit.empty() || (!number_in(before, '.') && !number_in(before, ','))) return std::nullopt;
  return MeasuredCell{before, unit};
}

std::optional<double> sexagesimal(std::string_view cell) {
  if (cell.empty() || is_digit(cell.back())) return std::nullopt;
  std::string_view rest = without_blanks(cell);
  const bool minus = !take(rest, kMinus).empty();
  if (!minus) (void)take(rest, kPlus);
  double out = 0.0, scale = 1.0;
  int parts = 0;
  for (const Signs signs : {Signs(kDegree), Signs(kMinute), Signs(kSecond)}) {
    if (rest.empty()) break;
    const auto value = part(rest);
    if (!value || (parts > 0 && *value >= 60.0)) return std::nullopt;
    rest = without_blanks(rest);
    if (take(rest, signs).empty()) return std::nullopt;
    rest = without_blanks(rest);
    out += *value * scale;
    scale /= 60.0;
    ++parts;
  }
  if (parts < 2 || !rest.empty()) return std::nullopt;
  return minus ? -out : out;
}

}  // namespace plumb::offline
