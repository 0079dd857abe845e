// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "report/pages.hpp"
#include "show/diagnose_view.hpp"

namespace plumb::offline::report {

Html missing_page(const ReportData& data, const ReportFigures& figures) {
  Html html;
  if (!data.diagnosis) {
    html.paragraph(data.why_no_diagnosis);
    return html;
  }
  if (data.diagnosis_is_kept)
    html.paragraph(
        fmt::format("This diagnosis was made earlier, of the same cell and data, and kept "
                    "with run {}.",
                    data.run.number));
  html.blocks(show::diagnosis_blocks(data.cell, *data.diagnosis, show::Candidates::kFirst),
              [&](const std::string&) { figures.put(Page::kMissing, html); });
  return html;
}

}  // namespace plumb::offline::report
