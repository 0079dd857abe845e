// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "figures/run_results.hpp"

namespace plumb::offline::figures {

/// A figure that can be drawn: its name, where JN stands for a joint such as J2, and what it shows.
struct FigureRow {
  std::string name;
  std::string shows;  // one line, without a full stop
};

/// Every figure, in the order of a report.
const std::vector<FigureRow>& figure_list();

/// The names that a cell has: JN is replaced by each of its joints.
std::vector<std::string> figure_names(const Cell& cell);

/// The SVG file of a figure, `width` px wide; nothing if this cell has no figure of that name.
std::optional<std::string> drawn(const std::string& name, const RunResults& results, double width);

}  // namespace plumb::offline::figures
