// SPDX-License-Identifier: Apache-2.0
#include "bus_text/reach.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "plumb/drivers/can_form.hpp"
#include "plumb/runtime/coupling.hpp"

namespace plumb::drivers {
namespace {

/// The largest number of counts that a value of this message can hold.
double most_counts(const BusLayout& layout, const MessageLayout& message) {
  return std::ldexp(1.0, 8 * can_form(layout, message).value_bytes - 1) - 1.0;
}

/// The smallest size of one count [um or urad], rounded up to 0.1, with which `needed` [m or rad]
/// takes at most `most` counts.
double count_for(double needed, double most) {
  return std::ceil(needed / most * 1e6 * 10.0) / 10.0;
}

/// How far the controller's value of a joint goes [rad or m] while all angles are within limits.
double most_of_value(const format::Chain& chain, std::size_t joint) {
  double low = 0.0, high = 0.0;
  for (std::size_t j = 0; j < chain.joints.size(); ++j) {
    std::array<double, format::kMaxJoints> share{};
    share[j] = 1.0;
    Coupling(chain.coupling).to_values(share);
    const double a = share[joint] * chain.joints[j].q_min, b = share[joint] * chain.joints[j].q_max;
    low += std::min(a, b);
    high += std::max(a, b);
  }
  return std::max(std::abs(low), std::abs(high));
}

void check_joints(const BusLayout& layout, const MessageLayout& message, const format::Chain& chain,
                  const std::string& path, std::vector<LayoutFault>& out) {
  const double most = most_counts(layout, message);
  for (std::size_t i = 0; i < std::min(message.signals.size(), chain.joints.size()); ++i) {
    const Signal& signal = message.signals[i];
    const double needed = most_of_value(chain, i);
    if (needed <= most * signal.scale) continue;
    out.push_back({message.name, "count_" + signal.unit,
                   fmt::format("{} of {} reaches {:.4g} {unit}, but the joint {:.4g} {unit}",
                               signal.name, message.name, most * signal.scale, needed,
                               fmt::arg("unit", signal.unit == "um" ? "m" : "rad")),
                   fmt::format("[{}.{}] count_{} = {:.10g}", path, message.name, signal.unit,
                               count_for(needed, most))});
  }
}

void check_offset(const BusLayout& layout, const MessageLayout& message, double needed,
                  const std::string& path, std::vector<LayoutFault>& out) {
  const double most = most_counts(layout, message);
  const double reach = most * message.signals.front().scale;
  if (needed <= reach) return;
  out.push_back({message.name, "count_um",
                 fmt::format("an offset reaches {:.4g} mm, but a correction {:.4g} mm", reach * 1e3,
                             needed * 1e3),
                 fmt::format("[{}.offset] count_um = {:.10g}", path, count_for(needed, most))});
}

}  // namespace

std::vector<LayoutFault> find_short_reach(const BusLayout& layout, const format::Chain& chain,
                                          double max_correction_m, const std::string& path) {
  std::vector<LayoutFault> out;
  if (layout.can_format == CanFrame::Format::kFd) return out;
  for (const MessageLayout& message : layout.messages)
    if (message.kind == MessageKind::kJoints || message.kind == MessageKind::kCommanded)
      check_joints(layout, message, chain, path, out);
    else if (message.kind == MessageKind::kOffset)
      check_offset(layout, message, max_correction_m, path, out);
  return out;
}

}  // namespace plumb::drivers
