// SPDX-License-Identifier: Apache-2.0
#include "fit/run_store.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "fit/cell_data.hpp"
#include "program/file.hpp"
#include "simulate/simulate.hpp"

namespace plumb::offline {
namespace {

namespace fs = std::filesystem;

/// A cell on disk with simulated measurements, removed at the end.
class RunStore : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("plumb-run-store-" + std::to_string(getpid()));
    fs::create_directories(folder_);
    Cell cell = random_cell(1, 6, format::Convention::kStandard, ArmKind::kRevolute);
    cell.measurement.files = {folder_ / "measurements.csv"};
    cell.file = folder_ / "cell.toml";
    cell.directory = folder_;
    SimulationPlan plan;
    plan.poses = 45;  // few: five folds
    plan.truth.geometry_m = plan.truth.geometry_rad = 5e-4;
    write_file_atomically(folder_ / "measurements.csv", simulated_csv(cell, simulate(cell, plan)));
    write_file_atomically(cell.file, write_cell(cell));
    cell_ = read_cell(cell.file);
    measured_ = read_cell_measurements(cell_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_;
  Cell cell_;
  Measurements measured_;
};

TEST_F(RunStore, ARunReadsBackToTheSameBits) {
  const offline::Run saved = save_run(cell_, measured_, fit_cell(cell_, measured_));
  const offline::Run loaded = load_run(cell_, saved.number);
  const Calibration &a = saved.fit.calibration, &b = loaded.fit.calibration;
  EXPECT_EQ(a.state.arm.calibrated, b.state.arm.calibrated);
  EXPECT_EQ(a.state.arm.domain, b.state.arm.domain);
  EXPECT_EQ(a.state.X_MB, b.state.X_MB);
  EXPECT_EQ(a.state.X_TG, b.state.X_TG);
  EXPECT_EQ(a.covariance, b.covariance);
  EXPECT_EQ(saved.fit.predicted_M, loaded.fit.predicted_M);
  EXPECT_EQ(saved.fit.split.fold, loaded.fit.split.fold);
  EXPECT_EQ(saved.fit.split.held, loaded.fit.split.held);
  EXPECT_EQ(saved.fit.held.mean, loaded.fit.held.mean);
  EXPECT_EQ(saved.inputs, loaded.inputs);
}

TEST_F(RunStore, RunsAreNumberedInOrderAndNeverChanged) {
  const Fit fit = fit_cell(cell_, measured_);
  for (int k = 1; k <= 3; ++k) EXPECT_EQ(save_run(cell_, measured_, fit).number, k);
  EXPECT_EQ(list_runs(cell_), (std::vector<int>{1, 2, 3}));
  for (const auto& entry : fs::directory_iterator(folder_ / "runs"))
    EXPECT_EQ(entry.path().filename().string().size(), 4u) << entry.path();
}

TEST_F(RunStore, TheCurrentRunIsTheLatestOfTheSameCellFileAndData) {
  EXPECT_FALSE(current_run(cell_, measured_).has_value());
  const Fit fit = fit_cell(cell_, measured_);
  save_run(cell_, measured_, fit);
  save_run(cell_, measured_, fit);
  EXPECT_EQ(current_run(cell_, measured_)->number, 2);
  Cell edited = cell_;
  edited.text += "\n# edited\n";
  EXPECT_FALSE(current_run(edited, measured_).has_value());
}

TEST_F(RunStore, ADamagedOrMissingRunIsAnInputErrorAndNeverTheCurrentOne) {
  const offline::Run run = save_run(cell_, measured_, fit_cell(cell_, measured_));
  std::ofstream(run.directory / "run.json") << "{\"schema\": \"run/1\"";
  EXPECT_THROW((void)load_run(cell_, run.number), Failure);
  EXPECT_THROW((void)load_run(cell_, 99), Failure);
  EXPECT_FALSE(current_run(cell_, measured_).has_value());
}

}  // namespace
}  // namespace plumb::offline
