// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace plumb::offline::draw {

inline constexpr int kMostTicks = 12;  // of an axis: more cannot be read at a glance

struct Tick {
  double value = 0.0;
  std::string text;
};

/// Ticks at whole multiples of 1, 2 or 5 times a power of ten, from the last one that is not above
/// `low` to the first that is not below `high`: at least 2 and at most `most` (3 to kMostTicks) of
/// them. A range that is empty, reversed or not finite becomes one around its finite end, or
/// 0 to 1. All texts have the same number of decimals, and zero has no sign.
std::vector<Tick> round_ticks(double low, double high, int most);

/// Ticks of a logarithmic axis: powers of ten, or only every second, fifth ... power if there are
/// more than `most`; also 2 and 5 times these if there is room. An end that is not above 0 is
/// replaced by a power of ten near the other end; without any range it is 1 to 10.
std::vector<Tick> log_ticks(double low, double high, int most);

/// The number with so many significant digits, without an exponent and without a sign on zero:
/// "0.0412", "412", "41200".
std::string digits(double value, int significant);

}  // namespace plumb::offline::draw
