// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "study/planar_study.hpp"

namespace plumb::offline::figures {

/// File name and SVG text of every figure: errors of the calibrated arm (the paper's Figs. 4, 5),
/// leaves over them (6, 7), leaves of the trees alone (8, 9), and the total error of every model
/// (10) on one scale a pair. Axes: joint angles in deg.
std::vector<std::pair<std::string, std::string>> planar_figures(const study::PlanarStudy& study);

}  // namespace plumb::offline::figures
