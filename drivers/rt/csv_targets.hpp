// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "plumb/runtime/transform.hpp"

namespace plumb::drivers::rt {

/// One row of a targets file: the desired tool pose in the base frame, and joint positions [rad] or
/// [m].
struct CsvTarget {
  Transformd X_BD;
  std::vector<double> q;
};

/// Reads the columns x_mm y_mm z_mm, q1_deg … (or _rad, _mm), and all of qw qx qy qz if there is an
/// orientation. Other columns and lines that begin with # are ignored. Throws Failure (kInput,
/// E-RT-CSV).
std::vector<CsvTarget> read_csv_targets(const std::filesystem::path& file, int joints);

}  // namespace plumb::drivers::rt
