// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "check/coverage.hpp"
#include "check/data_findings.hpp"
#include "check/data_sense.hpp"
#include "check/effect_rules.hpp"
#include "fit/orientation_words.hpp"
#include "program/counted_words.hpp"
#include "report/page_words.hpp"
#include "report/pages.hpp"
#include "show/units.hpp"

namespace plumb::offline::report {
namespace {

constexpr std::size_t kMostExcluded = 30;

std::vector<int> rows_used(const Split& split) {
  std::vector<int> out;
  for (std::size_t i = 0; i < split.used.size(); ++i)
    if (split.used[i]) out.push_back(static_cast<int>(i));
  return out;
}

std::string split_words(const ReportData& data) {
  const Split& split = data.run.fit.split;
  if (data.results.held.empty()) return "No reading is held out; every reading used is fitted.";
  if (split.folds > 0)
    return fmt::format(
        "Every reading is held out once: the poses are dealt into {} parts, and each part is "
        "predicted by a model that was fitted to the others. Repeats of a pose stay together.",
        split.folds);
  return fmt::format("{} are held out, {}; the fit never sees them. {} are fitted.",
                     counted_words(data.results.held.size(), "reading", "readings"),
                     split.marked ? "as the measurement file marks them"
                                  : "chosen evenly over the joint positions",
                     counted_words(data.results.fit.size(), "reading", "readings"));
}

std::string counts_words(const ReportData& data, const std::vector<int>& used) {
  const auto& group = data.measured.replicate_group;
  const int poses = group.empty() ? 0 : 1 + *std::max_element(group.begin(), group.end());
  const auto rows = static_cast<std::size_t>(data.measured.size());
  return fmt::format(
      "The files hold {} at {}; {} used.", counted_words(rows, "reading", "readings"),
      counted_words(static_cast<std::size_t>(poses), "pose", "different poses"),
      used.size() == rows ? "all of them are" : counted_words(used.size(), "is", "are"));
}

std::string repeats_words(const Measurements& measured) {
  std::map<int, int> readings;
  for (const int group : measured.replicate_group) ++readings[group];
  int poses = 0, most = 0;
  for (const auto& [group, n] : readings) {
    poses += n > 1;
    most = std::max(most, n);
  }
  if (poses == 0)
    return "No pose was measured more than once, so the readings themselves say nothing about "
           "their "
           "noise.";
  return fmt::format("{} measured more than once, up to {} times; this is how the noise is known.",
                     counted_words(static_cast<std::size_t>(poses), "pose was", "poses were"),
                     most);
}

show::Table excluded_table(const ReportData& data) {
  const Fit& fit = data.run.fit;
  show::Table table{.caption = "Readings that stand out or are not used",
                    .head = {"pose", "row", "error [mm]", "what became of it"},
                    .left_from = 3};
  const auto add = [&](const Outlier& o, const char* fate) {
    table.rows.push_back(
        {data.results.pose(o.row), fmt::format("{}", o.row + 1), show::mm(o.error_m),
         fmt::format("{:.1f} times the usual scatter away from where the others put it: {}",
                     o.times, fate)});
  };
  // With folds a reading is fitted and held out, and may stand out as both.
  const auto& left_out = fit.calibration.outliers;
  const auto is_left_out = [&](const Outlier& held) {
    return std::any_of(left_out.begin(), left_out.end(),
                       [&](const Outlier& other) { return other.row == held.row; });
  };
  for (const auto& o : fit.held_outliers)
    add(o, is_left_out(o) ? "left out of the fit and of the verdict"
                          : "held out, and left out of the verdict");
  for (const auto& o : left_out)
    if (std::none_of(fit.held_outliers.begin(), fit.held_outliers.end(),
                     [&](const Outlier& held) { return held.row == o.row; }))
      add(o, "left out of the fit");
  for (int row = 0; row < data.measured.size(); ++row) {
    const auto i = static_cast<std::size_t>(row);
    if (fit.split.used[i]) continue;
    const bool marked = !data.measured.set.empty() && data.measured.set[i] == SetMark::kIgnore;
    table.rows.push_back({data.results.pose(row), fmt::format("{}", row + 1), "",
                          marked ? "not used: the file marks it as ignore"
                                 : "not used: it repeats a pose that is held out"});
  }
  return table;
}

void put_excluded(const ReportData& data, Html& html) {
  html.heading("Excluded readings, and why");
  show::Table table = excluded_table(data);
  if (table.rows.empty())
    return html.paragraph("None: no reading contradicts the others, and none is marked as ignore.");
  const std::size_t all = table.rows.size();
  if (all > kMostExcluded) {
    table.rows.resize(kMostExcluded);
    table.caption += fmt::format(": the first {} of {}", kMostExcluded, all);
  }
  html.table(table);
}

show::Table coverage_table(const Cell& cell, const Coverage& found) {
  show::Table table{.caption = "How far each joint moves",
                    .head = {"joint", "used", "limits", "unit", "share", "poses"},
                    .left_from = 5};
  for (std::size_t j = 0; j < found.joints.size(); ++j) {
    const auto& c = found.joints[j];
    const bool length = show::slides(cell.nominal.joints[j]);
    const auto span = [&](double a, double b) {
      return fmt::format("{:.0f} .. {:.0f}", show::shown(a, length), show::shown(b, length));
    };
    table.rows.push_back({c.joint, span(c.q_min, c.q_max), span(c.limit_min, c.limit_max),
                          show::unit(length), percent_words(c.share), c.text});
  }
  return table;
}

std::string box_words(const Coverage& found) {
  std::string out;
  for (std::size_t k = 0; k < 3; ++k)
    out += fmt::format("{}{} from {:.0f} to {:.0f} mm", k > 0 ? ", " : "", "xyz"[k],
                       show::to_mm(found.box_min[k]), show::to_mm(found.box_max[k]));
  return "In the base frame the measured points lie in " + out + ".";
}

void put_testable(const std::vector<Testable>& effects, Html& html) {
  html.heading("What these data can show");
  std::vector<std::string> yes;
  show::Table table{.caption = "What they can show only weakly, or not at all",
                    .head = {"effect", "can show", "why", "to measure"},
                    .left_from = 1};
  for (const auto& e : effects)
    if (e.answer == Testable::Answer::kYes)
      yes.push_back(e.effect);
    else
      table.rows.push_back(
          {e.effect, e.answer == Testable::Answer::kWeakly ? "weakly" : "no", e.why, e.measure});
  html.paragraph(yes.empty()
                     ? "They are too few to show any effect."
                     : fmt::format("{}: {}.",
                                   counted_words(yes.size(), "effect of the library can be tested",
                                                 "effects of the library can be tested"),
                                   listed_words(yes)));
  html.table(table);
}

}  // namespace

Html data_page(const ReportData& data, const ReportFigures& figures) {
  Html html;
  const auto used = rows_used(data.run.fit.split);
  html.paragraph(counts_words(data, used) + " " + split_words(data));
  html.paragraph(repeats_words(data.measured));
  if (const auto said = orientation_remark(data.run.fit.orientations))
    html.paragraph("Of the orientations: " + said->message + ".");
  std::vector<std::string> findings;
  for (const auto& found :
       {limit_findings(data.cell, data.measured), constant_findings(data.cell, data.measured)})
    for (const auto& problem : found) findings.push_back(problem.message);
  html.list(findings);
  put_excluded(data, html);
  html.heading("Coverage");
  if (!used.empty()) {
    const Coverage found = coverage(data.cell, data.measured, used, data.run.fit.calibration.state);
    html.paragraph(box_words(found));
    html.table(coverage_table(data.cell, found));
  }
  figures.put(Page::kData, html);
  put_testable(testable_effects(data_sense(data.cell, data.measured, used)), html);
  return html;
}

}  // namespace plumb::offline::report
