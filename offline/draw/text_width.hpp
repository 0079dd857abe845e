// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace plumb::offline::draw {

/// Width [px] of a text in a sans-serif font of `size` px: that of DejaVu Sans, one of the widest
/// fonts in use, so that what fits by this estimate fits with any usual font. Cost: one pass.
double text_width(std::string_view utf8, double size);

/// The text in lines no wider than `width` px, broken at spaces; a longer word stands alone.
std::vector<std::string> wrapped(const std::string& text, double size, double width);

/// The text if it fits into `width` px, else its beginning and "…".
std::string shortened(const std::string& text, double size, double width);

}  // namespace plumb::offline::draw
