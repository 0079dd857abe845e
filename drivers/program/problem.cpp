// SPDX-License-Identifier: Apache-2.0
#include "program/problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "program/printable.hpp"
#include "program/utf8.hpp"

namespace plumb {
namespace {

const char* word(Severity severity) {
  switch (severity) {
    case Severity::kError:
      return "error";
    case Severity::kWarning:
      return "warning";
    default:
      return "note";
  }
}

constexpr const char* kReplacement = "\xEF\xBF\xBD";  // one column wide, so that carets stay right
constexpr int kWindow = 72;                           // characters of a source line shown

struct Excerpt {
  std::string text;
  int caret = 0;  // characters before the caret
};

/// The part of a long line around the caret.
Excerpt excerpt(const Place& place) {
  const auto line = printable_characters(place.source);
  const int size = static_cast<int>(line.size());
  const int at = std::clamp(place.column - 1, 0, size);
  const int first = size <= kWindow ? 0 : std::clamp(at - kWindow / 2, 0, size - kWindow);
  const int last = std::min(size, first + kWindow);
  Excerpt out{.text = first > 0 ? "…" : "", .caret = at - first + (first > 0 ? 1 : 0)};
  for (int i = first; i < last; ++i)
    out.text += printable_line(line[i]) == line[i] ? line[i] : kReplacement;
  if (last < size) out.text += "…";
  return out;
}

std::string render_place(const Place& place) {
  std::string at = printable_line(place.file);
  if (place.line > 0) at += fmt::format(":{}", place.line);
  if (place.line > 0 && place.column > 0) at += fmt::format(":{}", place.column);
  if (place.source.empty() || place.line <= 0) return fmt::format("\n  --> {}", at);
  const std::string number = std::to_string(place.line);
  const std::string gutter(number.size() + 2, ' ');
  const Excerpt shown = excerpt(place);
  std::string out =
      fmt::format("\n{}--> {}\n{}|\n {} | {}", gutter.substr(1), at, gutter, number, shown.text);
  if (place.column > 0)
    out += fmt::format("\n{}| {}{}{}{}", gutter, std::string(shown.caret, ' '),
                       std::string(std::clamp(place.length, 1, kWindow), '^'),
                       place.label.empty() ? "" : " ", printable_line(place.label));
  return out;
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

std::string render(const Problem& problem) {
  std::string out = fmt::format("{}[{}]: {}", word(problem.severity), problem.code,
                                printable_line(problem.message));
  if (problem.place) out += render_place(*problem.place);
  if (!problem.help.empty()) {
    const bool caret = problem.place && !problem.place->source.empty() && problem.place->line > 0;
    const std::size_t width = caret ? std::to_string(problem.place->line).size() + 2 : 2;
    out += fmt::format("\n{}= help: {}", std::string(width, ' '), printable_line(problem.help));
  }
  return out;
}

Failure::Failure(Exit exit, std::vector<Problem> problems)
    : exit_(exit), problems_(std::move(problems)) {
  if (problems_.empty()) return;
  what_ = problems_.front().message;
  if (problems_.size() > 1) what_ += fmt::format(" (and {} more)", problems_.size() - 1);
}

Failure::Failure(Exit exit, Problem problem)
    : Failure(exit, std::vector<Problem>{std::move(problem)}) {}

// Optimal string alignment distance: insert, delete, replace, swap neighbours.
int edit_distance(const std::string& a, const std::string& b) {
  const std::size_t n = a.size(), m = b.size();
  std::vector<std::vector<int>> d(n + 1, std::vector<int>(m + 1));
  for (std::size_t i = 0; i <= n; ++i) d[i][0] = static_cast<int>(i);
  for (std::size_t j = 0; j <= m; ++j) d[0][j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= n; ++i)
    for (std::size_t j = 1; j <= m; ++j) {
      const int cost = a[i - 1] == b[j - 1] ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + cost});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[n][m];
}

std::optional<std::string> did_you_mean(const std::string& word,
                                        const std::vector<std::string>& candidates) {
  // One edit in three characters: a word that differs by more is another word.
  const int most = std::max(1, static_cast<int>(word.size()) / 3);
  std::optional<std::string> best;
  int best_distance = most + 1;
  for (const auto& candidate : candidates) {
    const int distance = edit_distance(lower(word), lower(candidate));
    if (distance >= best_distance) continue;
    best_distance = distance;
    best = candidate;
  }
  return best;
}

}  // namespace plumb
