// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <regex>
#include <string>
#include <vector>

namespace plumb::offline {

/// A text of a drawing, read back from the file, and the room that it takes in a narrow estimate of
/// this test's own: 0.45 of the font size a character, which no sans-serif font undercuts on
/// average of a label. Two such boxes that overlap do so in every font.
struct TextBox {
  std::string words;
  double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;
  bool overlaps(const TextBox& other) const {
    return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
  }
};

inline std::vector<TextBox> text_boxes(const std::string& svg) {
  static const std::regex kText(
      "<text x=\"([-0-9.]+)\" y=\"([-0-9.]+)\" text-anchor=\"(\\w+)\" font-size=\"([0-9.]+)\"[^>]*>"
      "([^<]*)</text>");
  std::vector<TextBox> out;
  for (auto it = std::sregex_iterator(svg.begin(), svg.end(), kText); it != std::sregex_iterator();
       ++it) {
    const double x = std::stod((*it)[1]), y = std::stod((*it)[2]), size = std::stod((*it)[4]);
    int characters = 0;
    bool entity = false;  // "&lt;" is one character
    for (const char c : (*it)[5].str()) {
      if (!entity) characters += (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
      entity = c == '&' || (entity && c != ';');
    }
    const double w = 0.45 * size * characters;
    const std::string anchor = (*it)[3];
    const double left = anchor == "start" ? x : anchor == "middle" ? x - 0.5 * w : x - w;
    out.push_back({(*it)[5], left, y - 0.75 * size, left + w, y + 0.2 * size});
  }
  return out;
}

/// "'a' touches 'b'" of every pair of texts that overlap, and of every text outside the width.
inline std::string collisions(const std::string& svg, double width) {
  const auto boxes = text_boxes(svg);
  std::string out;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (boxes[i].left < 0.0 || boxes[i].right > width)
      out += "'" + boxes[i].words + "' leaves the drawing\n";
    for (std::size_t j = i + 1; j < boxes.size(); ++j)
      if (boxes[i].overlaps(boxes[j]))
        out += "'" + boxes[i].words + "' touches '" + boxes[j].words + "'\n";
  }
  return out;
}

inline int count(const std::string& text, const std::string& what) {
  int out = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++out;
  return out;
}

}  // namespace plumb::offline
