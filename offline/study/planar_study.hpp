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

/// A tree for x and one for y over the box they were trained in.
struct AxisTrees {
  format::Domain domain;
  std::array<format::Tree, 2> tree;
};

/// What the trees say, shape (n, 2) [m].
Samples values(const AxisTrees& trees, const RowsN& q);

/// Whose model a row shows.
enum class RowKind { kPublished, kComparison, kOurs, kPhysics };

/// A model of the study and its errors, always on positions without noise.
struct StudyRow {
  std::string key;    // "calibrated_llmt"
  std::string model;  // in words
  std::string size;   // "90 + 75 leaves"
  RowKind kind = RowKind::kPublished;
  std::optional<TotalError> paper = {};  // Table 1 [m]
  TotalError test = {};                  // the 5985 positions of the study [m]
  TotalError disjoint = {};              // 20,000 random ones inside the trained box [m]
  Eigen::VectorXd error_at_test = {};    // (5985,) [m]
  std::optional<AxisTrees> trees = {};
};

struct PlanarRequest {
  PlanarVariant variant = PlanarVariant::kPublished;
  double noise_m = 0.0;  // 1 sigma per axis on what is learnt from
  std::uint64_t seed = 1;
  enum class Grids { kAll, kWithoutFinest } grids = Grids::kAll;  // the finest takes half a minute
  std::function<void(const std::string&)> tell = [](const std::string&) {};  // progress
};

struct PlanarStudy {
  PlanarRequest request;
  LinkCalibration links;
  RowsN test_q;  // (5985, 2)
  std::vector<StudyRow> rows;
  std::string diagnosis;             // the verdict of diagnose in words
  std::vector<std::string> remarks;  // what deviates from the paper, and why

  const StudyRow& row(const std::string& key) const;
};

/// The five models of Table 1 as published, textbook smoothing, our trees, and the missing physics.
/// Sizes and ridges of our trees are chosen by cross-validation on the training poses.
PlanarStudy run_planar_study(const PlanarRequest& request);

}  // namespace plumb::offline::study
