// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

namespace plumb::offline::draw {

/// Colours by meaning. Each has one value on a light and one on a dark background. The colours that
/// tell classes apart, from kBlue on, are those of Okabe and Ito, which colour-blind readers can
/// distinguish.
enum class Tone {
  kPaper,
  kInk,
  kMuted,
  kGrid,
  kBand,
  kBlue,
  kVermilion,
  kGreen,
  kPurple,
  kOrange,
  kCount
};

/// What an area or a line is painted with: a tone, a fixed colour "#rrggbb", or nothing.
class Paint {
 public:
  Paint() = default;
  Paint(Tone tone) : tone_(tone), set_(true) {}
  explicit Paint(std::string colour) : colour_(std::move(colour)), set_(true) {}

  bool is_tone() const { return set_ && colour_.empty(); }
  int tone() const { return static_cast<int>(tone_); }

  /// The same paint with this opacity, 0 .. 1.
  Paint faded(double opacity) const;
  double opacity() const { return opacity_; }

  /// The colour on a light ground, or "none".
  std::string value() const;

 private:
  Tone tone_ = Tone::kInk;
  std::string colour_;
  double opacity_ = 1.0;
  bool set_ = false;
};

/// viridis, for magnitudes: share 0 is dark, 1 is bright. Clamped; NaN counts as 0.
Paint magnitude_colour(double share);

/// Blue or vermilion, for signed values: share -1 .. 1. The nearer to 0, the more of the ground
/// shows through, so that small values are faint on a light as on a dark ground. NaN counts as 0.
Paint signed_colour(double share);

/// Whether black letters can be read on this share of magnitude_colour better than white ones.
bool is_bright(double share);

/// The style sheet of every figure, always the same bytes, so that a page can allow it by its hash.
/// The colours follow `prefers-color-scheme`; the class plumb-light or plumb-dark on the figure, or
/// on what it stands in, forces one of the two. On paper it is always light.
const std::string& style_sheet();

}  // namespace plumb::offline::draw
