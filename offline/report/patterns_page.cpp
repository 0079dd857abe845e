// SPDX-License-Identifier: Apache-2.0
#include "report/pages.hpp"
#include "show/compare_view.hpp"

namespace plumb::offline::report {

Html patterns_page(const ReportData& data, const ReportFigures& figures) {
  Html html;
  html.blocks(show::pattern_blocks(data.cell, data.measured, data.comparison, data.run.fit), {});
  figures.put(Page::kPatterns, html);
  return html;
}

}  // namespace plumb::offline::report
