// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "figures/joint_residual.hpp"

/// What drives the deviation of a joint: waves of its gear, the load on it. Each returns one SVG
/// file, `width` px wide (320 to 4000), whatever the data.
namespace plumb::offline::figures {

/// How much of the squared deviations of a joint a wave of one frequency explains, over the
/// frequency: a weighted least-squares periodogram with a free mean [Lomb 1976; Zechmeister &
/// Kuerster 2009].
struct Spectrum {
  std::vector<double> cycles;  // a turn [1] or a metre [1/m], ascending
  std::vector<double> share;   // 0 .. 1
  double chance = 1.0;         // share that noise exceeds anywhere once in a hundred spectra
  double apart = 0.0;          // closest frequencies that the range of the joint can tell apart
  int points = 0;
};

/// The spectrum of `value`, one deviation for each pose of `joint`. `ratio`: of the gear, 0 if it
/// is not known; the spectrum then reaches beyond twice a turn of the motor. Empty if the poses are
/// fewer than six or the joint does not move. Cost: frequencies * poses.
Spectrum spectrum_of(const JointResidual& joint, const std::vector<double>& value, double ratio);

/// Frequencies of the highest peaks above chance, highest first, each apart from those before.
std::vector<std::size_t> peaks_of(const Spectrum& spectrum, std::size_t most);

/// The spectrum of what the model leaves of a joint, and of what would be there without the law
/// that the run fitted; peaks named, the gear ratio marked.
std::string spectrum_figure(const RunResults& results, const JointResidual& joint, double width);

/// The deviation of a joint over the torque of gravity about it [N m], or the force along it [N],
/// with the spring that the run fitted, or else the straight line that the points would have.
std::string load_figure(const RunResults& results, const JointResidual& joint, double width);

/// Whether the load on a joint varies, without which its figure shows nothing.
bool load_varies(const RunResults& results, const JointResidual& joint);

/// Each formula of the run over the input that it follows most, with what it has to explain at each
/// pose.
std::string formulas_figure(const RunResults& results, double width);

}  // namespace plumb::offline::figures
