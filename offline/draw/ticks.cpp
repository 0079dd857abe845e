// SPDX-License-Identifier: Apache-2.0
#include "draw/ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace plumb::offline::draw {
namespace {

constexpr double kSlack = 1e-9;  // of a step: rounding of what lies on a tick
constexpr double kSmallest = 1e-300, kLargest = 1e300;  // so that no range overflows

std::pair<double, double> sound_range(double low, double high) {
  if (!std::isfinite(low)) low = std::isfinite(high) ? high : 0.0;
  if (!std::isfinite(high)) high = low;
  low = std::clamp(low, -kLargest, kLargest);
  high = std::clamp(high, -kLargest, kLargest);
  if (low > high) std::swap(low, high);
  const double size = std::max(std::abs(low), std::abs(high));
  if (high - low > 1e-9 * size && high - low > kSmallest) return {low, high};
  if (size < kSmallest) return {0.0, 1.0};
  return {low - 0.1 * size, high + 0.1 * size};
}

/// The next larger of 1, 2, 5 times a power of ten.
double larger_step(double step) {
  const double power = std::pow(10.0, std::floor(std::log10(step) + kSlack));
  const double lead = step / power;
  return power * (lead < 1.5 ? 2.0 : lead < 3.5 ? 5.0 : 10.0);
}

std::string fixed(double value, int decimals) {
  std::string out = fmt::format("{:.{}f}", value, decimals);
  if (out.find_first_not_of("-0.") == std::string::npos && out.front() == '-') out.erase(0, 1);
  return out;
}

std::string tick_text(double value, double step, double largest) {
  if (largest >= 1e7 || step < 1e-6) return fmt::format("{:g}", value + 0.0);
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + kSlack)));
  return fixed(value, decimals);
}

}  // namespace

std::vector<Tick> round_ticks(double low, double high, int most) {
  most = std::clamp(most, 3, kMostTicks);
  std::tie(low, high) = sound_range(low, high);
  double step = std::pow(10.0, std::floor(std::log10((high / most - low / most))) - 1.0);
  const auto first = [&] { return std::floor(low / step + kSlack); };
  const auto last = [&] { return std::ceil(high / step - kSlack); };
  while (last() - first() + 1 > most) step = larger_step(step);
  std::vector<Tick> out;
  const double largest = step * std::max(std::abs(first()), std::abs(last()));
  for (double k = first(); k <= last(); k += 1.0)
    out.push_back({k * step + 0.0, tick_text(k * step, step, largest)});
  return out;
}

std::vector<Tick> log_ticks(double low, double high, int most) {
  most = std::clamp(most, 3, kMostTicks);
  if (!std::isfinite(high) || high <= 0.0) high = 10.0;
  if (!std::isfinite(low) || low <= 0.0 || low > high) low = std::min(1.0, 0.1 * high);
  const double first = std::floor(std::log10(low) + kSlack);
  const double last = std::max(first + 1.0, std::ceil(std::log10(high) - kSlack));
  const double decades = last - first;
  std::vector<Tick> out;
  const auto add = [&](double value) { out.push_back({value, fmt::format("{:g}", value)}); };
  const bool between = 3.0 * decades + 1.0 <= most;
  const double stride = std::max(1.0, std::ceil(decades / (most - 2)));
  for (double k = first; k < last; k += stride) {
    add(std::pow(10.0, k));
    if (!between) continue;
    add(2.0 * std::pow(10.0, k));
    add(5.0 * std::pow(10.0, k));
  }
  add(std::pow(10.0, first + stride * std::ceil(decades / stride)));
  return out;
}

std::string digits(double value, int significant) {
  if (!std::isfinite(value)) return "none";
  if (value == 0.0) return "0";
  const double at = std::floor(std::log10(std::abs(value)));
  const double unit = std::pow(10.0, at - significant + 1);
  const double rounded = std::round(value / unit) * unit;
  const double top = std::floor(std::log10(std::abs(rounded)) + kSlack);
  return fixed(rounded, std::max(0, static_cast<int>(significant - 1 - top)));
}

}  // namespace plumb::offline::draw
