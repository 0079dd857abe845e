// SPDX-License-Identifier: Apache-2.0
#include "draw/text_width.hpp"

#include <array>
#include <sstream>

namespace plumb::offline::draw {
namespace {

/// Advance widths of DejaVu Sans in thousandths of the font size, from ' ' to '~'.
constexpr std::array<int, 95> kAdvance{
    318, 401, 460, 838, 637, 951, 780, 275, 391, 391, 500, 838, 318, 361,  318, 337, 637, 637, 637,
    637, 637, 637, 637, 637, 637, 637, 337, 337, 838, 838, 838, 531, 1000, 685, 687, 699, 771, 632,
    576, 775, 752, 295, 295, 656, 558, 863, 749, 788, 604, 788, 695, 635,  611, 732, 685, 989, 686,
    611, 686, 391, 337, 391, 838, 500, 500, 613, 635, 550, 635, 616, 353,  635, 634, 278, 278, 580,
    278, 975, 634, 612, 635, 635, 412, 521, 393, 634, 592, 818, 592, 592,  525, 637, 337, 637, 838};
constexpr int kOther = 1000;  // of a character beyond ASCII: none of ours is wider

bool continues(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

}  // namespace

double text_width(std::string_view utf8, double size) {
  int sum = 0;
  for (const char c : utf8) {
    if (continues(c)) continue;
    const auto at = static_cast<unsigned char>(c) - static_cast<unsigned>(' ');
    sum += at < kAdvance.size() ? kAdvance[at] : kOther;
  }
  return 1e-3 * sum * size;
}

std::vector<std::string> wrapped(const std::string& text, double size, double width) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!lines.empty() && text_width(lines.back() + " " + word, size) <= width)
      lines.back() += " " + word;
    else
      lines.push_back(shortened(word, size, width));
  }
  return lines;
}

std::string shortened(const std::string& text, double size, double width) {
  if (text_width(text, size) <= width) return text;
  std::string out = text;
  while (!out.empty() && text_width(out + "…", size) > width) {
    while (!out.empty() && continues(out.back())) out.pop_back();
    if (!out.empty()) out.pop_back();
  }
  return out + "…";
}

}  // namespace plumb::offline::draw
