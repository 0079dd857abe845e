// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cli/target_rows.hpp"
#include "programs/joint_solutions.hpp"
#include "programs/rewriting.hpp"

namespace plumb::offline::cli {

/// What the command line says of programs.
struct FilterSettings {
  programs::Frames tools, frames;  // they count before what the programs state
  std::vector<double> start;       // joints before the first target [rad] or [m], or none
  bool joint_targets = false;      // these are corrected too
  bool robot_stands = false;       // external axes do not carry it
  int least_decimals = 0;          // of a millimetre
  programs::Mark mark;
};

struct Untouched {
  std::string file;
  int line = 0;
  std::string name, why, help;
};

/// A program with corrected targets, and what was done.
struct Filtered {
  std::vector<std::string> bytes;  // of each source
  int targets = 0;  // corrected, or in `untouched`; without the joint targets left as they are
  int corrected = 0;
  int changed = 0;        // corrected targets of which a digit changed
  int refused = 0;        // of the untouched: the correction refused them
  int joint_targets = 0;  // left as they are
  std::vector<Untouched> untouched;
  double largest_m = 0.0;
  double rounding_m = 0.0;  // the most that the digits of the file leave out
  programs::Decimals decimals;
  double between_m = 0.0;                // along the linear moves whose both ends are corrected
  int linear_moves = 0;                  // of these, those whose error is known
  std::vector<std::string> other_tools;  // tools that are not the model's
};

/// Corrects the targets of programs with a model, which must outlive it: each target by
/// corrected_row(), as `plumb correct` does, from the joint positions of the nominal arm that its
/// configuration, or the targets before it, say.
class ProgramFilter {
 public:
  ProgramFilter(const format::Model& model, FilterSettings settings);
  ~ProgramFilter();

  Filtered filter(const programs::Language& language, const programs::Program& program);

  /// Over all programs.
  const TargetTotals& found() const { return found_; }

 private:
  class One;
  const format::Model& model_;
  SinglePoses poses_;
  programs::JointSolutions solutions_;
  FilterSettings settings_;
  std::vector<std::string> sensors_;
  TargetTotals found_;
};

}  // namespace plumb::offline::cli
