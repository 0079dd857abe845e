// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "plumb/format/model.hpp"
#include "study/link_calibration.hpp"
#include "study/planar_poses.hpp"

namespace plumb::offline::study {

/// A tree for x and one for y, with the box in which they were trained.
struct AxisTrees {
  format::Domain domain;
  std::array<format::Tree, 2> tree;
};

/// The values of the trees, shape (n, 2) [m].
Samples values(const AxisTrees& trees, const RowsN& q);

/// The origin of the model in a row.
enum class RowKind { kPublished, kComparison, kOurs, kPhysics };

/// A model of the study and its errors, always relative to positions without noise.
struct StudyRow {
  std::string key;    // "calibrated_llmt"
  std::string model;  // description
  std::string size;   // "90 + 75 leaves"
  RowKind kind = RowKind::kPublished;
  std::optional<TotalError> paper = {};  // Table 1 [m]
  TotalError test = {};                  // the 5985 positions of the study [m]
  TotalError disjoint = {};              // 20,000 random positions inside the trained box [m]
  Eigen::VectorXd error_at_test = {};    // (5985,) [m]
  std::optional<AxisTrees> trees = {};
};

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

  const StudyRow& row(const std::string& key) const;
};

/// Runs the study: the five models of Table 1 as published, smoothing as in textbooks, the trees of
/// Plumb, and the missing physics. Sizes and ridges of Plumb's trees are chosen by cross-validation
/// on the training poses.
PlanarStudy run_planar_study(const PlanarRequest& request);

}  // namespace plumb::offline::study
