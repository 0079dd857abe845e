// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "fit/verdict.hpp"
#include "report/pages.hpp"
#include "show/compare_words.hpp"

namespace plumb::offline::report {

Html patterns_page(const ReportData& data, const ReportFigures& figures) {
  Html html;
  const auto& found = data.comparison;
  html.paragraph(show::lack_of_fit_words(found.lack_of_fit, held_out_excess_of(data.run.fit)));
  html.list({show::joint_words(data.cell, found), show::order_words(found.order),
             show::changes_words(found.changes)});
  std::vector<std::string> moved;
  for (const auto& step : found.changes.steps)
    moved.push_back(show::step_words(data.cell, data.measured, step));
  for (const auto& drift : found.changes.drifts)
    moved.push_back(show::drift_words(data.cell, data.measured, drift));
  html.list(moved);
  figures.put(Page::kPatterns, html);
  return html;
}

}  // namespace plumb::offline::report
