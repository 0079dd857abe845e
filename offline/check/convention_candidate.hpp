// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "check/convention_sweep.hpp"
#include "check/interpretation.hpp"
#include "check/interpreted_cells.hpp"
#include "check/regularised_fit.hpp"

namespace plumb::offline {

/// An interpretation and the arm as it is placed by it.
struct ConventionCandidate {
  Interpretation interpretation;
  RegularisedFit placed;
};

/// Places and fits the few candidates that a sweep leaves, on more poses than it looked at.
class CandidateFitter {
 public:
  /// some: the poses, as labelled. All references must outlive the fitter.
  CandidateFitter(const Cell& cell, const Measurements& some, const Convention& labels,
                  InterpretedCells& cells);

  /// Frame and target, from the linear map M of measured onto base coordinates.
  ConventionCandidate placed(const Convention& c, Eigen::Matrix3d M,
                             const Eigen::Vector3d& target_T);
  /// The same of a lead, with its length units resolved; mirrored: the points are left-handed.
  ConventionCandidate placed(const ConventionLead& lead, bool mirrored);
  /// The same of the files as labelled, from `loose` or, if that is better, as `fit` starts.
  ConventionCandidate as_labelled(const LinearPlacement& loose);
  /// The geometry as well, near nominal.
  void fit(ConventionCandidate& candidate);

 private:
  const Cell& cell_;
  const Measurements& some_;
  const Convention& labels_;
  InterpretedCells& cells_;
  std::vector<int> rows_;  // all of some_
};

}  // namespace plumb::offline
