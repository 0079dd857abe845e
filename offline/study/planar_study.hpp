// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "study/link_calibration.hpp"
#include "study/planar_poses.hpp"
#include "study/study_row.hpp"

namespace plumb::offline::study {

struct PlanarRequest {
  PlanarVariant variant = PlanarVariant::kPublished;
  double noise_m = 0.0;  // 1 sigma per axis of the training data
  std::uint64_t seed = 1;
  enum class Grids { kAll, kWithoutFinest } grids = Grids::kAll;  // the finest: half a minute
  std::function<void(const std::string&)> tell = [](const std::string&) {};  // progress
};

struct PlanarStudy {
  PlanarRequest request;
  LinkCalibration links;
  RowsN test_q;  // (5985, 2)
  std::vector<StudyRow> rows;
  std::string diagnosis;             // the verdict of diagnose as a sentence
  std::vector<std::string> remarks;  // what deviates from the paper, and why

  const StudyRow& row(const std::string& key) const { return row_of(rows, key); }
};

/// Runs the study: the five models of Table 1 as published, smoothing as in textbooks, the trees of
/// Plumb, and the missing physics. Sizes and ridges of Plumb's trees are chosen by cross-validation
/// on the training poses.
PlanarStudy run_planar_study(const PlanarRequest& request);

}  // namespace plumb::offline::study
