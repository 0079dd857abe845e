// SPDX-License-Identifier: Apache-2.0
#include "draw/paint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plumb::offline::draw {
namespace {

constexpr auto kTones = static_cast<std::size_t>(Tone::kCount);

constexpr std::array<const char*, kTones> kLight{"#ffffff", "#1b1f24", "#57606a", "#e1e5ea",
                                                 "#d5e4f0", "#0072b2", "#d55e00", "#00785a",
                                                 "#a8437f", "#9a6700"};
constexpr std::array<const char*, kTones> kDark{"#12161b", "#e8ecf0", "#a3adb8", "#2b323a",
                                                "#1d3a52", "#56b4e9", "#ff9447", "#2ec79b",
                                                "#e08fc0", "#e6c229"};

using Colour = std::array<double, 3>;

/// viridis [Smith & van der Walt 2015], every eighth of the scale.
constexpr std::array<Colour, 9> kViridis{{{68, 1, 84},
                                          {71, 45, 123},
                                          {59, 82, 139},
                                          {44, 114, 142},
                                          {33, 145, 140},
                                          {40, 174, 128},
                                          {94, 201, 98},
                                          {173, 220, 48},
                                          {253, 231, 37}}};

std::string variables(const std::array<const char*, kTones>& colours) {
  std::string out = "{";
  for (std::size_t i = 0; i < kTones; ++i) out += fmt::format("--plumb-{}:{};", i, colours[i]);
  return out + "}";
}

std::string made_style() {
  const std::string light = variables(kLight), dark = variables(kDark);
  std::string out = ".plumb-figure" + light + "\n@media (prefers-color-scheme:dark){.plumb-figure" +
                    dark + "}\n.plumb-light .plumb-figure,.plumb-figure.plumb-light" + light +
                    "\n.plumb-dark .plumb-figure,.plumb-figure.plumb-dark" + dark +
                    "\n@media print{.plumb-figure.plumb-figure" + light + "}\n";
  for (std::size_t i = 0; i < kTones; ++i)
    out += fmt::format(
        ".plumb-figure .f{0}{{fill:var(--plumb-{0})}}.plumb-figure "
        ".s{0}{{stroke:var(--plumb-{0})}}",
        i);
  return out + "\n";
}

}  // namespace

std::string Paint::value() const {
  if (!set_) return "none";
  return colour_.empty() ? kLight[static_cast<std::size_t>(tone_)] : colour_;
}

Paint magnitude_colour(double share) {
  const double at = (share > 0.0 ? std::min(share, 1.0) : 0.0) * (kViridis.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(at), kViridis.size() - 2);
  const double part = at - static_cast<double>(i);
  std::string out = "#";
  for (std::size_t k = 0; k < 3; ++k)
    out += fmt::format(
        "{:02x}", static_cast<int>(
                      std::lround(kViridis[i][k] + part * (kViridis[i + 1][k] - kViridis[i][k]))));
  return Paint(out);
}

Paint Paint::faded(double opacity) const {
  Paint out = *this;
  out.opacity_ = opacity > 0.0 ? std::min(opacity, 1.0) : 0.0;
  return out;
}

Paint signed_colour(double share) {
  return Paint(share < 0.0 ? Tone::kBlue : Tone::kVermilion).faded(std::abs(share));
}

bool is_bright(double share) { return share > 0.55; }

const std::string& style_sheet() {
  static const std::string sheet = made_style();
  return sheet;
}

}  // namespace plumb::offline::draw
