// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace plumb::tests {

/// Why a text is no well-formed XML of elements, attributes and character data; empty if it is.
/// Written apart from what makes it.
inline std::string xml_fault(const std::string& text) {
  std::vector<std::string> open;
  for (std::size_t at = 0; at < text.size();) {
    if (text[at] == '&' && text.compare(at, 4, "&lt;") != 0 && text.compare(at, 4, "&gt;") != 0 &&
        text.compare(at, 5, "&amp;") != 0 && text.compare(at, 5, "&#39;") != 0 &&
        text.compare(at, 6, "&quot;") != 0)
      return "a bare ampersand";
    if (text[at] != '<') {
      if (text[at] == '>') return "a bare >";
      if (open.empty() && text[at] != '\n') return "text outside of the root";
      ++at;
      continue;
    }
    const auto end = text.find('>', at);
    if (end == std::string::npos) return "a tag that does not end";
    const std::string tag = text.substr(at + 1, end - at - 1);
    if (tag.find('<') != std::string::npos) return "a tag inside a tag";
    const std::string name = tag.substr(0, tag.find_first_of(" /", 1));
    long quotes = 0;
    for (const char c : tag) quotes += c == '"' ? 1 : 0;
    if (quotes % 2 != 0) return "an open quotation in " + name;
    if (tag[0] == '/') {
      if (open.empty() || "/" + open.back() != tag) return "unexpected end of " + tag;
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(name);
    }
    at = end + 1;
  }
  return open.empty() ? "" : open.back() + " is not ended";
}

}  // namespace plumb::tests
