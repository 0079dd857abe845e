// SPDX-License-Identifier: Apache-2.0
#include "urdf/urdf_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string_view>
#include <utility>

#include "cell/csv_number.hpp"
#include "cell/unmarked_utf16.hpp"
#include "program/shell_word.hpp"

namespace plumb::offline {
namespace {

/// Larger angles look like degrees: rotations between links beyond one turn (2 pi as people round
/// it), and joint limits beyond ten turns, which cables allow no arm.
constexpr double kMostTurn_rad = 6.2832, kMostLimit_rad = 62.832;

/// The end of the comment, CDATA section or instruction that begins at `at`; `at` itself for tags.
std::size_t behind_no_tag(std::string_view text, std::size_t at) {
  for (const auto& [begin, end] : {std::pair<std::string_view, std::string_view>{"<!--", "-->"},
                                   {"<![CDATA[", "]]>"},
                                   {"<?", "?>"},
                                   {"<!", ">"}})
    if (text.substr(at).starts_with(begin)) {
      const auto found = text.find(end, at);
      return found == std::string_view::npos ? text.size() : found + end.size();
    }
  return at;
}

/// Calls visit(tag, key, begin, end) for every attribute: the name of its element, its own name,
/// and where its value begins and ends in the text.
void each_attribute(std::string_view text,
                    const std::function<void(std::string_view, std::string_view, std::size_t,
                                             std::size_t)>& visit) {
  for (std::size_t at = text.find('<'); at < text.size(); at = text.find('<', at)) {
    if (const std::size_t behind = behind_no_tag(text, at); behind != at) {
      at = behind;
      continue;
    }
    const std::size_t begin = at + 1;
    const auto tag = text.substr(begin, text.find_first_of(" \t\r\n/>", begin) - begin);
    std::size_t name = begin + tag.size();
    for (at = name; at < text.size() && text[at] != '>'; ++at) {
      if (text[at] != '"' && text[at] != '\'') continue;
      const std::size_t end = std::min(text.find(text[at], at + 1), text.size());
      auto key = text.substr(name, at - name);
      key.remove_prefix(std::min(key.find_first_not_of(" \t\r\n"), key.size()));
      visit(tag, key.substr(0, key.find_first_of(" \t\r\n=")), at + 1, end);
      at = end;
      name = end + 1;
    }
  }
}

std::string root_of(std::string_view text) {
  for (std::size_t at = text.find('<'); at < text.size(); at = text.find('<', at)) {
    const std::size_t behind = behind_no_tag(text, at);
    if (behind == at)
      return std::string(text.substr(at + 1, text.find_first_of(" \t\r\n/>", at + 1) - at - 1));
    at = behind;
  }
  return "";
}

/// True if the text has elements or expressions that xacro replaces. The declaration of the prefix
/// alone does not count: a file that xacro wrote keeps it.
bool is_xacro(std::string_view text) {
  bool out = false;
  each_attribute(text, [&](auto tag, auto, std::size_t begin, std::size_t end) {
    const auto value = text.substr(begin, end - begin);
    out = out || tag.starts_with("xacro:") || value.find("${") != std::string_view::npos ||
          value.find("$(") != std::string_view::npos;
  });
  return out;
}

[[noreturn]] void no_urdf(const std::string& file, std::string message, std::string help) {
  throw Failure(Exit::kInput, {.code = "E-URDF",
                               .message = std::move(message),
                               .place = Place{.file = file},
                               .help = std::move(help)});
}

void check_kind(const std::string& text, const std::string& file) {
  const std::string root = root_of(text);
  if (is_xacro(text))
    no_urdf(file, "this is xacro, from which a URDF is made",
            fmt::format("xacro {} > arm.urdf, and read that", shell_word(file)));
  if (root == "robot") return;
  const std::string help = "export the robot as URDF, whose root element is <robot>";
  if (root == "sdf") no_urdf(file, "this is SDF, no URDF", help);
  if (root == "mujoco") no_urdf(file, "this is MJCF (MuJoCo), no URDF", help);
  if (root.empty()) no_urdf(file, "this is no XML, and so no URDF", help);
}

/// The numbers of "0 1.57 0", as far as they are numbers.
std::vector<double> numbers_of(std::string_view text) {
  std::vector<double> out;
  while (!text.empty()) {
    const auto end = std::min(text.find(' '), text.size());
    double value = 0.0;
    if (read_number(text.substr(0, end), ' ', value) == NumberFault::kNone) out.push_back(value);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return out;
}

}  // namespace

std::string urdf_text(std::string text, const std::string& file) {
  if (const std::string name = utf16_name(text); !name.empty())
    no_urdf(file, "the file is UTF-16, and a URDF is read in UTF-8",
            fmt::format("iconv -f {} -t UTF-8 {} | sed '1s/UTF-16/UTF-8/' > arm.urdf", name,
                        shell_word(file)));
  check_kind(text, file);
  std::vector<std::pair<std::size_t, std::size_t>> values;
  each_attribute(text, [&](auto, auto, std::size_t begin, std::size_t end) {
    values.emplace_back(begin, end);
  });
  for (const auto& [begin, end] : values)
    for (std::size_t at = begin; at < end; ++at)
      if (text[at] == '\t' || text[at] == '\n' || text[at] == '\r') text[at] = ' ';
  return text;
}

std::vector<Problem> urdf_unit_warnings(const std::string& text, const std::string& file) {
  double turn = 0.0, limit = 0.0;
  bool slides = false;
  each_attribute(text, [&](auto tag, auto key, std::size_t begin, std::size_t end) {
    const auto value = std::string_view(text).substr(begin, end - begin);
    if (tag == "joint" && key == "type") slides = value == "prismatic";
    const bool rpy = tag == "origin" && key == "rpy";
    const bool bound = tag == "limit" && !slides && (key == "lower" || key == "upper");
    if (!rpy && !bound) return;
    for (const double x : numbers_of(value))
      (rpy ? turn : limit) = std::max(rpy ? turn : limit, std::abs(x));
  });
  std::vector<Problem> out;
  const auto doubt = [&](double most, double allowed, const char* what) {
    if (most <= allowed) return;
    out.push_back({.severity = Severity::kWarning,
                   .code = "W-URDF-UNITS",
                   .message = fmt::format("{} of {:g} looks like degrees, and URDF is in radians",
                                          what, most),
                   .place = Place{.file = file},
                   .help = "if it is: convert the angles of the file, 90 deg is 1.570796"});
  };
  doubt(turn, kMostTurn_rad, "an angle in rpy");
  doubt(limit, kMostLimit_rad, "a limit of a joint that turns");
  return out;
}

}  // namespace plumb::offline
