// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <memory>

#include "catalogue/explanation.hpp"
#include "cell/cell.hpp"
#include "cell/codes.hpp"
#include "cli/verbs.hpp"
#include "program/screen.hpp"

namespace plumb::offline::cli {
namespace {

constexpr std::size_t kWidest = 88;  // characters; longer lines are hard to read

std::size_t line_width() { return std::min(kWidest, screen_of(STDOUT_FILENO).columns - 2); }

struct Chapter {
  std::string kind;
  std::vector<Explanation> entries;
};

std::vector<Explanation> listed(std::span<const Explanation> entries) {
  return {entries.begin(), entries.end()};
}

std::vector<Chapter> chapters() {
  auto codes = listed(code_explanations());
  for (const auto& [code, text] : cell_codes()) codes.push_back({code, text});
  std::sort(codes.begin(), codes.end(),
            [](const auto& a, const auto& b) { return a.name < b.name; });
  return {{"effect", listed(effect_explanations())},
          {"term", listed(term_explanations())},
          {"status", listed(status_explanations())},
          {"code", std::move(codes)}};
}

/// "Held out" and "held-out" are one word, and a column's head is found with its unit: "alone
/// [mm]".
std::string plain(std::string_view word) {
  std::string out;
  for (char c : word.substr(0, word.find('[')))
    if (c != '-' && c != '_' && c != ' ')
      out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

std::string wrapped(const std::string& text) {
  const std::size_t width = line_width();
  std::string out, line;
  std::size_t at = 0;
  while (at < text.size()) {
    const auto end = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, end - at);
    if (!line.empty() && line.size() + 1 + word.size() > width) {
      out += "  " + line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
    at = end + 1;
  }
  return out + "  " + line + "\n";
}

/// An effect may be explained before a cell may list it.
std::string availability(const Chapter& chapter, std::string_view name) {
  if (chapter.kind != "effect") return "";
  const auto& known = known_effects();
  if (std::find(known.begin(), known.end(), name) != known.end()) return "";
  return " In this version it can be simulated or explained, not fitted.";
}

void show(const Chapter& chapter, const Explanation& entry, Outcome& outcome) {
  const std::string text = std::string(entry.text) + availability(chapter, entry.name);
  outcome.result = {{"name", entry.name}, {"kind", chapter.kind}, {"text", text}};
  outcome.text = fmt::format("{} ({})\n\n{}", entry.name, chapter.kind, wrapped(text));
}

void show_all(Outcome& outcome) {
  outcome.result = Json::object();
  outcome.text = "plumb explain WORD, with one of these words\n";
  for (const auto& chapter : chapters()) {
    std::string names;
    auto& list = outcome.result[chapter.kind] = Json::array();
    for (const auto& entry : chapter.entries) {
      names += (names.empty() ? "" : ", ") + std::string(entry.name);
      list.push_back(entry.name);
    }
    outcome.text += fmt::format("\n{}\n{}", chapter.kind, wrapped(names));
  }
}

[[noreturn]] void unknown(const std::string& word) {
  std::vector<std::string> names;
  for (const auto& chapter : chapters())
    for (const auto& entry : chapter.entries) names.emplace_back(entry.name);
  auto near = did_you_mean(word, names);
  const auto begins = std::find_if(names.begin(), names.end(), [&](const auto& name) {
    return plain(name).starts_with(plain(word));
  });
  if (!near && begins != names.end()) near = *begins;
  throw Failure(Exit::kUsage,
                {.code = "E-EXPLAIN",
                 .message = fmt::format("there is nothing to explain about '{}'", word),
                 .help = near ? fmt::format("did you mean: plumb explain \"{}\"", *near)
                              : "list everything: plumb explain"});
}

void explain(const std::vector<std::string>& words, Outcome& outcome) {
  std::string word;
  for (const auto& part : words) word += (word.empty() ? "" : " ") + part;
  if (word.empty()) return show_all(outcome);
  const auto all = chapters();
  for (const auto& chapter : all)
    for (const auto& entry : chapter.entries)
      if (plain(entry.name) == plain(word)) return show(chapter, entry, outcome);
  unknown(word);
}

}  // namespace

void add_explain(Program& program) {
  const auto words = std::make_shared<std::vector<std::string>>();
  VerbOptions verb = program.verb(
      {.name = "explain",
       .summary = "Offline help: a message's code, an effect, a status, or a word of the field",
       .examples = "  plumb explain E-FIT-CONVERGE\n  plumb explain held-out",
       .in_cell = false},
      [words](const Globals&, Outcome& o) { explain(*words, o); });
  verb.add_option("WORD", *words, "Code, effect, status or term; without it all are listed");
}

}  // namespace plumb::offline::cli
