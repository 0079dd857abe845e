// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "answers/after_diagnosis.hpp"
#include "diagnose/effect_words.hpp"
#include "report/page_words.hpp"
#include "report/pages.hpp"
#include "show/diagnose_view.hpp"

namespace plumb::offline::report {
namespace {

constexpr std::size_t kMostCandidates = 12;

show::Table candidates_table(const Cell& cell, const Diagnosis& d) {
  show::Table table = show::candidates_table(cell, d, kMostCandidates);
  if (d.candidates.size() > kMostCandidates)
    table.caption += fmt::format("; {} of {}", kMostCandidates, d.candidates.size());
  return table;
}

show::Table untestable_table(const Diagnosis& d) {
  show::Table table{.caption = "Effects that these data cannot show",
                    .head = {"effect", "why", "to measure"},
                    .left_from = 1};
  for (const auto& t : d.not_testable) table.rows.push_back({t.effect, t.why, t.measure});
  return table;
}

void put_confounding(const Cell& cell, const Diagnosis& d, Html& html) {
  if (d.candidates.empty() || !d.candidates.front().supported) return;
  const std::string words = show::first_candidate_text(cell, d);
  if (!words.empty()) html.paragraph(words);
}

}  // namespace

Html missing_page(const ReportData& data, const ReportFigures& figures) {
  Html html;
  if (!data.diagnosis) {
    html.paragraph(data.why_no_diagnosis);
    return html;
  }
  const Diagnosis& d = *data.diagnosis;
  html.paragraph(d.text);
  if (data.diagnosis_is_kept)
    html.paragraph(
        fmt::format("This diagnosis was made earlier, of the same cell and data, and kept "
                    "with run {}.",
                    data.run.number));
  put_confounding(data.cell, d, html);
  figures.put(Page::kMissing, html);
  html.table(candidates_table(data.cell, d));
  if (!d.outliers.empty())
    html.paragraph(fmt::format("Left out of the diagnosis, because the others contradict {}: {}.",
                               d.outliers.size() == 1 ? "it" : "them", listed_words(d.outliers)));
  html.heading("What to do next");
  std::vector<std::string> next;
  for (const auto& words : after_diagnosis(data.cell, d)) next.push_back("plumb " + words);
  html.preformatted("Commands to type next", fmt::format("{}", fmt::join(next, "\n")));
  html.table(untestable_table(d));
  return html;
}

}  // namespace plumb::offline::report
