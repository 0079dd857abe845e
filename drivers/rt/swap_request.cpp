// SPDX-License-Identifier: Apache-2.0
#include "rt/swap_request.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "rt/screen_units.hpp"

namespace plumb::drivers::rt {
namespace {

constexpr std::string_view kWithin = "within_um=";

}  // namespace

std::string swap_line(const SwapRequest& request) {
  if (request.change_m <= 0.0) return "swap " + request.file;
  return fmt::format("swap {}{:.0f} {}", kWithin, 1e6 * request.change_m, request.file);
}

SwapRequest read_swap(const std::string& words) {
  SwapRequest out{.file = words};
  if (!words.starts_with(kWithin)) return out;
  double um = 0.0;
  const char* const end = words.data() + words.size();
  const auto read = std::from_chars(words.data() + kWithin.size(), end, um);
  if (read.ec != std::errc() || read.ptr == end || *read.ptr != ' ' || !std::isfinite(um))
    return out;
  out.change_m = 1e-6 * std::max(0.0, um);
  out.file = std::string(read.ptr + 1, end);
  return out;
}

std::string change_fault(const ModelChange& change, const SwapRequest& request,
                         const Ceilings& ceilings) {
  const double wider = std::max(1.0, request.change_m / ceilings.change_m);
  if (change.compared == 0) return "no pose could be compared with the running model";
  if (change.position_m > wider * ceilings.change_m)
    return fmt::format(
        "it changes corrections by up to {:.3f} mm, and {:.3f} mm are allowed; if that is meant: "
        "plumb-rt swap FILE --allow-change-mm {:.3f}",
        1e3 * change.position_m, 1e3 * wider * ceilings.change_m,
        std::ceil(1.05e3 * 1e3 * change.position_m) / 1e3);
  if (change.rotation_rad > wider * ceilings.change_rad)
    return fmt::format(
        "it changes corrections of the orientation by up to {:.4f} deg, and {:.4f} deg are allowed "
        "([limits] max_change_deg)",
        change.rotation_rad / kDegree, wider * ceilings.change_rad / kDegree);
  return "";
}

}  // namespace plumb::drivers::rt
