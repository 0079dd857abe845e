// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "answers/after_diagnosis.hpp"
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
  show::Blocks blocks =
      show::diagnosis_blocks(data.cell, *data.diagnosis, show::Candidates::kFirst);
  for (const auto& words : after_diagnosis(data.cell, *data.diagnosis))
    blocks.emplace_back(action_of(words));
  html.blocks(blocks, [&](const std::string&) { figures.put(Page::kMissing, html); });
  return html;
}

}  // namespace plumb::offline::report
