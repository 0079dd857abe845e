// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "program/counted_words.hpp"
#include "report/pages.hpp"
#include "show/fit_view.hpp"
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

/// Of very many numbers the first ones: plumb fit --json lists all.
show::Blocks shortened(show::Blocks blocks) {
  for (show::Block& block : blocks) {
    auto* const table = std::get_if<show::Table>(&block);
    if (table == nullptr || table->rows.size() <= kMostParameters) continue;
    table->caption += fmt::format(": the first {} of {}; plumb fit --json lists all",
                                  kMostParameters, table->rows.size());
    table->rows.resize(kMostParameters);
  }
  return blocks;
}

}  // namespace

Html parameters_page(const ReportData& data, const ReportFigures& figures) {
  Html html;
  html.paragraph(parameters_sentence(data.run.fit.calibration.estimates));
  figures.put(Page::kParameters, html);
  html.blocks(shortened(show::arm_blocks(data.cell, data.run.fit)), [](const std::string&) {});
  return html;
}

}  // namespace plumb::offline::report
