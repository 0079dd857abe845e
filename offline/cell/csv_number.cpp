// SPDX-License-Identifier: Apache-2.0
#include "cell/csv_number.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace plumb::offline {
namespace {

NumberFault read_with_point(std::string_view text, double& value) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (stop != end || error == std::errc::invalid_argument) return NumberFault::kNotANumber;
  if (error == std::errc::result_out_of_range) return NumberFault::kOutOfRange;
  return std::isfinite(value) ? NumberFault::kNone : NumberFault::kNotFinite;
}

}  // namespace

NumberFault read_number(std::string_view text, char separator, double& value) {
  std::array<char, 64> buffer;  // longer ones are no decimal comma anybody wrote
  if (text.empty()) return NumberFault::kEmpty;
  if (separator != ';' || text.find(',') == std::string_view::npos || text.size() > buffer.size())
    return read_with_point(text, value);
  std::replace_copy(text.begin(), text.end(), buffer.begin(), ',', '.');
  return read_with_point({buffer.data(), text.size()}, value);
}

}  // namespace plumb::offline
