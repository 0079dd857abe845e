// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "fit/cell_data.hpp"
#include "fit/fit_cell.hpp"
#include "fit/point_distances.hpp"
#include "tests/cell/support.hpp"

/// Two real Pandas, calibrated with a printed ball in printed sockets 50 mm apart, moved by hand.
namespace plumb::offline {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCell = R"(schema = "cell/1"
[cell]
name = "panda"
tolerance_mm = 0.3
[robot]
name = "Franka Panda"
dh_convention = "modified"
length_unit = "mm"
angle_unit = "deg"
joints = [
  { name = "J1", theta = 0, d = 333, a = 0, alpha = 0 },
  { name = "J2", theta = 0, d = 0, a = 0, alpha = -90 },
  { name = "J3", theta = 0, d = 316, a = 0, alpha = 90 },
  { name = "J4", theta = 0, d = 0, a = 82.5, alpha = 90 },
  { name = "J5", theta = 0, d = 384, a = -82.5, alpha = -90 },
  { name = "J6", theta = 0, d = 0, a = 0, alpha = 90 },
  { name = "J7", theta = 0, d = 0, a = 88, alpha = 90 },
]
[measurement]
files = ["measurements.csv"]
[effects]
geometry = true
)";

std::vector<std::string> split_at_commas(const std::string& line) {
  std::vector<std::string> out;
  std::stringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) out.push_back(cell);
  return out;
}

/// pose, seven joints, position, socket: the label of a point is both.
std::string as_touches(const fs::path& file) {
  std::ifstream in(file);
  std::string line, out = "pose";
  for (int j = 1; j <= 7; ++j) out += fmt::format(",q{}_rad", j);
  out += ",position,point\n";
  std::getline(in, line);
  while (std::getline(in, line)) {
    const auto cells = split_at_commas(line);
    for (std::size_t k = 0; k < 9; ++k) out += cells[k] + ",";
    out += cells[8] + "/" + cells[9] + "\n";
  }
  return out;
}

class Panda : public testing::Test {
 protected:
  static fs::path data() { return PLUMB_SHARED_DATA; }
  void SetUp() override {
    if (!fs::exists(data())) GTEST_SKIP() << "no " << data();
  }
  /// With the sockets of whole placements held out, and no length known.
  Fit fitted(const char* file) {
    const auto cell_file = folder_.put("cell.toml", kCell);
    folder_.put("measurements.csv", as_touches(data() / file));
    cell_ = read_cell(cell_file);
    const MeasurementFiles measured = read_cell_measurements(cell_);
    return fit_cell(cell_, measured, {});
  }
  /// The sockets of one plate are 50 mm apart: every interval must hold that, give or take what a
  /// printer does.
  void expect_50_mm(const Fit& fit, std::size_t placements, double widest_m) {
    const auto distances = point_distances(cell_.measurement, fit.calibration);
    ASSERT_EQ(distances.size(), placements);
    for (const PointDistance& d : distances) {
      EXPECT_NEAR(d.length_m, 50e-3, d.half_m + 0.05e-3) << distance_words(cell_.measurement, d);
      EXPECT_LT(d.half_m, widest_m);
    }
  }
  Folder folder_;
  Cell cell_;
};

TEST_F(Panda, TheSecondReproducesItsSocketsAtPlacementsThatWereNotFitted) {
  const Fit fit = fitted("panda_2_clean.csv");
  EXPECT_GT(fit.nominal_held.mean, 7e-3);
  EXPECT_LE(fit.held.mean, 0.30e-3);
  EXPECT_EQ(fit.split.folds, 8);
  expect_50_mm(fit, 8, 0.8e-3);
}

TEST_F(Panda, TheThirdReproducesItsSocketsAtPlacementsThatWereNotFitted) {
  const Fit fit = fitted("panda_3.csv");
  EXPECT_GT(fit.nominal_held.mean, 2.5e-3);
  EXPECT_LE(fit.held.mean, 0.2005e-3);
  EXPECT_EQ(fit.split.folds, 6);
  expect_50_mm(fit, 6, 0.3e-3);
}

}  // namespace
}  // namespace plumb::offline
