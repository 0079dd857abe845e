// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "figures/run_figures.hpp"
#include "program/counted_words.hpp"
#include "report/page_words.hpp"
#include "report/pages.hpp"
#include "show/units.hpp"
#include "solve/series_numbers.hpp"

namespace plumb::offline::report {
namespace {

constexpr std::size_t kMostWorse = 10;
constexpr double kWorse = 2.0;  // times the noise floor, as in the waterfall

show::Table steps_table(const std::vector<figures::WaterfallStep>& steps) {
  show::Table table{.caption = "Mean error of the same held-out readings as the model grows",
                    .head = {"added", "mean [mm]", "change", "became worse"}};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const double before = i > 0 ? steps[i - 1].mean_m : 0.0;
    table.rows.push_back(
        {(i > 0 ? "+ " : "") + steps[i].added, show::mm(steps[i].mean_m),
         before > 0.0 ? fmt::format("{:+.0f} %", 100.0 * (steps[i].mean_m / before - 1.0)) : "",
         i > 0 ? fmt::format("{}", steps[i].worse) : ""});
  }
  return table;
}

void put_worse(const ReportData& data, Html& html) {
  const auto& results = data.results;
  std::vector<int> worse;
  for (const int row : results.held)
    if (results.after(row) > results.before(row) + kWorse * data.run.fit.floor.mean_m)
      worse.push_back(row);
  const auto growth = [&](int row) { return results.after(row) - results.before(row); };
  std::stable_sort(worse.begin(), worse.end(), [&](int a, int b) { return growth(a) > growth(b); });
  html.heading("Who got worse");
  if (worse.empty())
    return html.paragraph(
        fmt::format("None of the {} misses by more than before calibration, beyond noise.",
                    counted_words(results.held.size(), "held-out reading", "held-out readings")));
  html.paragraph(fmt::format(
      "{} of {} by more than before calibration, beyond noise.", worse.size(),
      counted_words(results.held.size(), "held-out reading misses", "held-out readings miss")));
  show::Table table{.caption = "Held-out readings that became worse [mm], the most first",
                    .head = {"pose", "before", "after"}};
  for (std::size_t i = 0; i < std::min(kMostWorse, worse.size()); ++i)
    table.rows.push_back({results.pose(worse[i]), show::mm(results.before(worse[i])),
                          show::mm(results.after(worse[i]))});
  html.table(table);
}

}  // namespace

Html added_page(const ReportData& data, const ReportFigures& figures) {
  Html html;
  if (data.results.held.empty()) {
    html.paragraph("No reading was held out, so nobody can say what each effect brings.");
    return html;
  }
  const auto steps = figures::waterfall_steps(data.results, data.earlier);
  if (steps.size() <= 2 && data.run.effects.size() > 1)
    html.paragraph(
        "All effects of this run came at once: there is no earlier run of the same data "
        "with fewer of them.");
  const std::string waves = series_words(data.cell, data.run.fit.calibration.state.arm);
  if (!waves.empty()) html.paragraph("Series of waves: " + waves + ".");
  if (data.run.fit.tree) html.paragraph("Tree: " + data.run.fit.tree->reason + ".");
  figures.put(Page::kAdded, html);
  html.table(steps_table(steps));
  put_worse(data, html);
  return html;
}

}  // namespace plumb::offline::report
