// SPDX-License-Identifier: Apache-2.0
#include "report/fleet_report.hpp"

#include <fmt/format.h>

#include "draw/svg.hpp"
#include "program/counted_words.hpp"
#include "report/document.hpp"
#include "report/fleet_figures.hpp"
#include "report/page_words.hpp"
#include "report/report_figures.hpp"
#include "show/counted.hpp"
#include "show/fleet_view.hpp"
#include "show/heads.hpp"
#include "show/units.hpp"

namespace plumb::offline::report {
namespace {

using fleet::CellSummary;
using fleet::Fleet;
using fleet::Model;

constexpr std::size_t kAllListed = 500;  // cells; of more only those that need attention

template <typename Figure>
void put_figure(Html& html, const Figure& figure) {
  const std::string wide = figure(kWide_px);
  if (!wide.empty()) html.figure(wide, figure(kNarrow_px));
}

Html verdict_section(const Fleet& fleet) {
  Html html;
  html.paragraph(show::fleet_verdict(fleet));
  put_figure(html, [&](double width) { return fleet_errors_figure(fleet, width); });
  html.table(show::effects_table(fleet));
  return html;
}

Html cells_section(const Fleet& fleet) {
  Html html;
  show::Table table{.caption = "Held-out errors, measured - predicted [mm]",
                    .head = {"cell", "arm", show::head::kMean, show::head::kP95, show::head::kMax,
                             show::head::kEffects, "verdict"},
                    .left_from = 5};
  for (const CellSummary* const cell : show::listed_cells(fleet, kAllListed)) {
    const auto mm = [&](double error_m) { return cell->ok ? show::mm(error_m) : "-"; };
    table.rows.push_back(
        {cell->name, cell->arm, mm(cell->held.mean), mm(cell->held.p95), mm(cell->held.max),
         show::counted(cell->effects),
         fmt::format("{} {}", verdict_mark(cell->verdict_class), show::state_of(fleet, *cell))});
    table.last_class.push_back(cell->verdict_class);
  }
  html.table(table);
  if (const auto left_out = fleet.cells.size() - table.rows.size(); left_out > 0)
    html.paragraph(fmt::format("{} that are good are not listed here; fleet.json has them all.",
                               counted_words(left_out, "arm", "arms")));
  return html;
}

Html model_section(const Fleet& fleet, const Model& model) {
  Html html;
  if (model.sisters.typical.empty()) {
    html.paragraph(show::too_few_words(model));
    return html;
  }
  put_figure(html, [&](double width) { return sisters_figure(fleet, model, width); });
  html.table(show::typical_table(model));
  html.paragraph(
      "Shrinkage: how much of an arm's own estimate gives way to the mean of its sisters, 0 % "
      "where "
      "its readings show the number well, 100 % where they do not show it. In a cell, [fit] "
      "prior_from = \"fleet.json\" makes use of it.");
  return html;
}

}  // namespace

std::string fleet_report(const Fleet& fleet) {
  std::vector<Section> sections;
  sections.push_back({"verdict", "Verdict", verdict_section(fleet)});
  sections.push_back({"cells", "The cells", cells_section(fleet)});
  std::vector<std::string> ids;
  for (std::size_t i = 0; i < fleet.models.size(); ++i)
    ids.push_back(fmt::format("model-{}", i + 1));
  for (std::size_t i = 0; i < fleet.models.size(); ++i) {
    const Model& model = fleet.models[i];
    sections.push_back(
        {ids[i].c_str(), draw::escaped(show::model_name(model)), model_section(fleet, model)});
  }
  return document("Fleet of " + counted_words(fleet.cells.size(), "arm", "arms"), sections);
}

}  // namespace plumb::offline::report
