// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "plumb/format/version.hpp"
#include "program/file.hpp"
#include "report/pages.hpp"

namespace plumb::offline::report {

Html reproduce_page(const ReportData& data) {
  Html html;
  html.paragraph(fmt::format(
      "These commands, with plumb {} and the files below, give the same figures; the choice of the "
      "held-out readings follows from the seed {}.",
      format::kVersion, data.cell.measurement.seed));
  html.preformatted("Commands", fmt::format("{}", fmt::join(data.commands, "\n")));
  show::Table table{.caption = "Input files", .head = {"file", "sha256"}, .left_from = 1};
  const std::string cell_sum = sha256(data.cell.text);
  table.rows.push_back({"cell.toml", cell_sum});
  if (data.run.cell_sha256 != hash_of(data.cell))
    table.rows.push_back({"cell.toml of the run", data.run.cell_sha256});
  for (const auto& input : data.run.inputs) table.rows.push_back({input.name, input.sha256});
  html.table(table);
  html.heading("cell.toml");
  html.preformatted("cell.toml", data.cell.text);
  return html;
}

}  // namespace plumb::offline::report
