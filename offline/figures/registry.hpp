// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "draw/sheet.hpp"
#include "figures/run_results.hpp"

namespace plumb::offline::figures {

/// Widths that a figure can be laid out for [px].
using draw::kNarrowest, draw::kWidest, draw::kUsualWidth;

/// A figure that can be drawn: its name, where JN stands for a joint such as J2, and what it shows.
struct FigureRow {
  std::string name;
  std::string shows;  // one line, without a full stop
  enum class Needs { kRun, kEarlierRuns, kDiagnosis, kPlan, kFits, kBench } needs = Needs::kRun;
};

/// Every figure, in the order of a report.
const std::vector<FigureRow>& figure_list();

/// Every figure that a cell has: its name and what it shows.
struct CellFigure {
  std::string name, shows;
};
std::vector<CellFigure> figures_of(const Cell& cell);

/// The names that a cell has: JN is replaced by each of its joints.
std::vector<std::string> figure_names(const Cell& cell);

/// Why the figure of that name would say no more than that there is nothing to show, such as "the
/// model has no tree"; empty if it shows something.
std::string why_empty(const std::string& name, const RunResults& results);

/// What the figure of that name is drawn from: a run; a run and the earlier ones of the same data;
/// a diagnosis, which `evidence` of evidence_figure.hpp draws; a plan of the next poses
/// (observability_figure.hpp); or the time that the cycle of the compiled run takes on this machine
/// (bench_figures.hpp). The last three take seconds, and `drawn` does not draw them.
FigureRow::Needs needs_of(const std::string& name);

/// The SVG file of a figure of a run, `width` px wide; nothing if this cell has no such figure
/// or it needs more than runs.
std::optional<std::string> drawn(const std::string& name, const RunResults& results, double width,
                                 const std::vector<Run>& earlier = {});

}  // namespace plumb::offline::figures
