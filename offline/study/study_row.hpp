// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "plumb/format/model.hpp"
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

/// The row of that key; throws std::out_of_range if there is none.
const StudyRow& row_of(const std::vector<StudyRow>& rows, const std::string& key);

}  // namespace plumb::offline::study
