// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "check/data_sense.hpp"
#include "report/page_words.hpp"
#include "report/pages.hpp"
#include "show/model_view.hpp"
#include "show/units.hpp"

namespace plumb::offline::report {
namespace {

constexpr int kPosesToCheck = 10;

show::Table ranges_table(const ReportData& data) {
  show::Table table{.caption = "Joint positions that the fit has seen",
                    .head = {"joint", "from", "to", "limits of the cell", "unit"},
                    .left_from = 4};
  const auto& q = data.measured.q;
  for (int j = 0; j < data.cell.joints(); ++j) {
    const auto& row = data.cell.nominal.joints[static_cast<std::size_t>(j)];
    const bool length = show::slides(row);
    double low = INFINITY, high = -INFINITY;
    for (const auto* rows : {&data.results.fit, &data.results.held}) {
      // Held-out rows count where folds fit them too.
      if (rows == &data.results.held && data.run.fit.split.folds == 0) continue;
      for (const int i : *rows) {
        low = std::min(low, q(i, j));
        high = std::max(high, q(i, j));
      }
    }
    if (low > high) continue;
    table.rows.push_back({row.name, fmt::format("{:.1f}", show::shown(low, length)),
                          fmt::format("{:.1f}", show::shown(high, length)),
                          fmt::format("{:.0f} .. {:.0f}", show::shown(row.q_min, length),
                                      show::shown(row.q_max, length)),
                          show::unit(length)});
  }
  return table;
}

std::vector<std::string> condition_words(const ReportData& data) {
  std::vector<int> used = data.results.fit;
  used.insert(used.end(), data.results.held.begin(), data.results.held.end());
  const DataSense sense = data_sense(data.cell, data.measured, used);
  std::vector<std::string> out;
  if (!sense.has_temperature)
    out.emplace_back(
        "Temperature: none was recorded. The figures of this report hold for the "
        "temperature of that day; how they change with it is not known.");
  else if (sense.temperature_span_K < 1.0)
    out.push_back(
        fmt::format("Temperature: {} varied by {:.1f} degC only, so nothing is known of "
                    "other temperatures.",
                    sense.temperature, sense.temperature_span_K));
  else
    out.push_back(fmt::format("Temperature: {} varied by {:.1f} degC while measuring.",
                              sense.temperature, sense.temperature_span_K));
  if (sense.payload_span_kg > 0.0)
    out.push_back(
        fmt::format("Payload: it varied by {:g} kg while measuring.", sense.payload_span_kg));
  else if (sense.has_payload)
    out.push_back(
        fmt::format("Payload: measured with one payload, {:g} kg; with another one the arm "
                    "yields differently, and nothing here says by how much.",
                    data.cell.payload.mass_kg));
  else
    out.emplace_back(
        "Payload: none is stated; the figures hold for the tool that carried the "
        "reflector.");
  if (sense.hours > 0.0)
    out.push_back(fmt::format("Time: all readings fall within {:.1f} hours.", sense.hours));
  if (!data.run.fit.still.empty())
    out.push_back(fmt::format("{} never moved: the model holds only where {} stood.",
                              listed_words(data.run.fit.still),
                              data.run.fit.still.size() == 1 ? "it" : "they"));
  if (data.controller)
    if (const auto words = show::context_text(data.controller->model); !words.empty())
      out.push_back("The model was trained with " + words + ".");
  return out;
}

std::string outside_words(const ReportData& data) {
  if (!data.controller) return {};
  const auto& model = data.controller->model;
  std::size_t leaves = 0;
  for (const auto& tree : model.trees) leaves += tree.leaves();
  return fmt::format(
      "Outside these ranges plumb-rt reports outside-domain: {}the correction fades out.",
      leaves > 0 ? fmt::format("the tree fades over {:.0f} % of a joint's range, then ",
                               100.0 * model.domain.fade)
                 : "");
}

/// The mean of ten readings lies below this with 97.5 %, if nothing has changed.
std::string check_words(const ReportData& data) {
  const auto& poses = data.comparison.poses;
  if (data.results.held.empty() || poses.size() < 3)
    return "Without held-out readings there is no figure against which a later check could be "
           "held.";
  double sum = 0.0, squares = 0.0;
  for (const auto& pose : poses) sum += pose.error_M.norm();
  const double mean = sum / static_cast<double>(poses.size());
  for (const auto& pose : poses) squares += std::pow(pose.error_M.norm() - mean, 2);
  const double sd = std::sqrt(squares / static_cast<double>(poses.size() - 1));
  return fmt::format(
      "To check later, measure {0} poses of this range and predict them with this run (plumb "
      "predict "
      "--as-measured --run {1} --data new.csv). While nothing has changed their mean error stays "
      "below {2} mm in 39 of 40 checks; above it, something has.",
      kPosesToCheck, data.run.number,
      show::mm(mean + 1.96 * sd / std::sqrt(double(kPosesToCheck))));
}

std::string when_words(const ReportData& data) {
  const auto& found = data.comparison.changes;
  if (!found.drifts.empty())
    return "The arm or the measurement drifted while it was measured, so check within a day.";
  if (!found.steps.empty())
    return "Something jumped while it was measured, so check before the model is used.";
  if (data.comparison.order.beyond())
    return "Readings that follow each other miss alike, which may be a slow change: check soon, at "
           "another time of the day.";
  if (found.visits == 0)
    return "These readings are too few to tell whether anything changed while they were taken.";
  return "Nothing changed while these readings were taken; check after a collision, and after a "
         "change of tool, gear, motor or foundation.";
}

}  // namespace

Html limits_page(const ReportData& data, const ReportFigures& figures) {
  Html html;
  html.paragraph("The figures of this report hold within these ranges. " + outside_words(data));
  html.table(ranges_table(data));
  html.list(condition_words(data));
  figures.put(Page::kLimits, html);
  html.heading("When to check again");
  html.paragraph(when_words(data));
  html.paragraph(check_words(data));
  return html;
}

}  // namespace plumb::offline::report
