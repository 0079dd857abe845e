// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "report/pages.hpp"
#include "show/compare_words.hpp"

namespace plumb::offline::report {

Html patterns_page(const ReportData& data, const ReportFigures& figures) {
  Html html;
  const auto& found = data.comparison;
  html.paragraph(show::lack_of_fit_words(found.lack_of_fit, data.run.fit));
  std::string changes = show::changes_words(found.changes);
  for (const auto& step : found.changes.steps)
    changes += " " + show::step_words(data.cell, data.measured, step) + ";";
  for (const auto& drift : found.changes.drifts)
    changes += " " + show::drift_words(data.cell, data.measured, drift) + ";";
  if (changes.ends_with(';')) changes.back() = '.';
  html.list({show::joint_words(data.cell, found), show::order_words(found.order), changes});
  figures.put(Page::kPatterns, html);
  return html;
}

}  // namespace plumb::offline::report
