// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "program/counted_words.hpp"
#include "report/page_words.hpp"
#include "report/pages.hpp"
#include "show/fit_view.hpp"
#include "show/heads.hpp"
#include "show/parameter_unit.hpp"

namespace plumb::offline::report {
namespace {

constexpr std::size_t kMostParameters = 200;
constexpr double kTwoSided95 = 1.96;  // standard deviations

const Estimate* most_significant(const std::vector<Estimate>& estimates) {
  const Estimate* best = nullptr;
  const auto times = [](const Estimate& e) { return std::abs(e.value - e.nominal) / e.std; };
  for (const Estimate& e : estimates)
    if (e.of_robot && e.std > 0.0 && (best == nullptr || times(e) > times(*best))) best = &e;
  return best;
}

std::string parameters_sentence(const std::vector<Estimate>& estimates) {
  std::size_t robot = 0, clear = 0;
  for (const Estimate& e : estimates) {
    robot += e.of_robot;
    clear += e.of_robot && std::abs(e.value - e.nominal) > kTwoSided95 * e.std;
  }
  std::string out = fmt::format(
      "{} of the arm and its effects {} fitted, and {} of frame and target; {} of the arm differ "
      "from "
      "nominal by more than their 95 % interval.",
      counted_words(robot, "number", "numbers"), robot == 1 ? "is" : "are",
      estimates.size() - robot, clear);
  if (const Estimate* best = most_significant(estimates)) {
    const auto unit = show::unit_of(*best);
    out += fmt::format(" The clearest change is that of {}: {} {}, {:.0f} standard deviations.",
                       best->name, unit.text(best->value - best->nominal), unit.name,
                       std::abs(best->value - best->nominal) / best->std);
  }
  return out;
}

show::Table parameters_table(const std::vector<Estimate>& estimates) {
  namespace head = show::head;
  show::Table table{.caption = "Fitted numbers of the arm and its effects",
                    .head = {head::kParameter, head::kNominal, head::kFitted, head::kChange,
                             "95 % interval of the change", "unit"},
                    .left_from = 5};
  for (const Estimate& e : estimates) {
    if (!e.of_robot) continue;
    const auto unit = show::unit_of(e);
    const double change = e.value - e.nominal, half = kTwoSided95 * e.std;
    table.rows.push_back(
        {e.name, unit.text(e.nominal), unit.text(e.value),
         (change > 0.0 ? "+" : "") + unit.text(change),
         std::isfinite(half) ? unit.text(change - half) + " .. " + unit.text(change + half) : "-",
         unit.name});
  }
  if (table.rows.size() > kMostParameters) {
    table.caption += fmt::format(": the first {} of {}; plumb fit --json lists all",
                                 kMostParameters, table.rows.size());
    table.rows.resize(kMostParameters);
  }
  return table;
}

}  // namespace

Html parameters_page(const ReportData& data, const ReportFigures& figures) {
  Html html;
  const Calibration& c = data.run.fit.calibration;
  html.paragraph(parameters_sentence(c.estimates));
  if (!c.held.empty())
    html.paragraph(fmt::format("Kept at nominal, because these poses say too little about {}: {}.",
                               c.held.size() == 1 ? "it" : "them", listed_words(c.held)));
  figures.put(Page::kParameters, html);
  html.table(parameters_table(c.estimates));
  html.heading("Where tracker and reflector stood");
  html.preformatted("Frame and target", show::measurement_text(data.cell, c.state, c.held));
  return html;
}

}  // namespace plumb::offline::report
