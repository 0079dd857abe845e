// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "catalogue/explanation.hpp"
#include "report/pages.hpp"

namespace plumb::offline::report {
namespace {

constexpr std::size_t kShortest = 3;  // letters of a term that is looked for in sentences

/// Terms that are everyday words: nobody looks them up.
constexpr std::array<std::string_view, 17> kEveryday{
    "used", "why",    "now",    "joint", "error", "before", "after",   "worst",     "size",
    "run",  "effect", "limits", "mean",  "max",   "change", "created", "to measure"};

/// Terms that mean what they say here only as heads of columns.
constexpr std::array<std::string_view, 5> kHeads{"alone", "share", "fall", "placed", "effects"};

template <std::size_t N>
bool is_of(const std::array<std::string_view, N>& list, std::string_view term) {
  return std::find(list.begin(), list.end(), term) != list.end();
}

bool is_letter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || (c & 0x80) != 0;
}

/// The words of the pages: no tags, no drawings.
std::string words_of(const std::string& html) {
  std::string out;
  for (std::size_t i = 0; i < html.size();) {
    if (html[i] != '<') {
      out += html[i++];
      continue;
    }
    if (html.compare(i, 4, "<svg") == 0 || html.compare(i, 4, "<pre") == 0) {
      const auto end = html.find(html[i + 1] == 's' ? "</div>" : "</pre>", i);
      i = end == std::string::npos ? html.size() : end;
      continue;
    }
    const auto end = html.find('>', i);
    i = end == std::string::npos ? html.size() : end + 1;
    out += ' ';
  }
  return out;
}

bool occurs(const std::string& text, std::string_view term) {
  for (auto at = text.find(term); at != std::string::npos; at = text.find(term, at + 1)) {
    const auto end = at + term.size();
    if ((at == 0 || !is_letter(text[at - 1])) && (end == text.size() || !is_letter(text[end])))
      return true;
  }
  return false;
}

bool is_head(const std::string& html, std::string_view term) {
  return html.find("<th scope=\"col\">" + std::string(term) + "<") != std::string::npos ||
         html.find("<th scope=\"col\" class=\"left\">" + std::string(term) + "<") !=
             std::string::npos;
}

bool is_met(const std::string& html, const std::string& words, std::string_view term) {
  if (is_of(kEveryday, term)) return false;
  if (is_head(html, term)) return true;
  const bool abbreviation = term == "DH" || term == "TCP";
  return !is_of(kHeads, term) && (term.size() >= kShortest || abbreviation) && occurs(words, term);
}

}  // namespace

Html glossary_page(const ReportData& data, const std::string& pages) {
  const std::string words = words_of(pages);
  std::vector<std::pair<std::string, std::string>> found;
  for (const auto& term : term_explanations())
    if (is_met(pages, words, term.name)) found.emplace_back(term.name, term.text);
  for (const auto& effect : effect_explanations())
    if (std::find(data.run.effects.begin(), data.run.effects.end(), effect.name) !=
        data.run.effects.end())
      found.emplace_back(effect.name, effect.text);
  const auto lower = [](const std::string& text) {
    std::string out;
    for (const char c : text) out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return out;
  };
  std::stable_sort(found.begin(), found.end(),
                   [&](const auto& a, const auto& b) { return lower(a.first) < lower(b.first); });
  Html html;
  html.paragraph("The terms that occur in this report; plumb explain knows more.");
  html.facts(found);
  return html;
}

}  // namespace plumb::offline::report
