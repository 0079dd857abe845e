// SPDX-License-Identifier: Apache-2.0
#include "runs/run_store.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "cell/run_checksum.hpp"
#include "fit/cell_data.hpp"
#include "fit/fit_cell.hpp"
#include "fit/orientation_words.hpp"
#include "program/file.hpp"
#include "runs/earlier_runs.hpp"
#include "simulate/simulate.hpp"
#include "tests/cases/random_cell.hpp"

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
  MeasurementFiles measured_;
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

TEST_F(RunStore, WhatTheOrientationsWereJudgedToBeIsKeptInTheSameWords) {
  using Kind = MeasuredOrientations::Kind;
  Fit fit = fit_cell(cell_, measured_);
  for (const Kind kind : {Kind::kNone, Kind::kGood, Kind::kScattered, Kind::kMissed, Kind::kTurned,
                          Kind::kConstant, Kind::kNominal, Kind::kContradict, Kind::kUnexplained}) {
    fit.orientations = {.kind = kind,
                        .interpretations = {},
                        .labelled_rad = 2e-3,
                        .left_rad = 1e-3,
                        .stated = kind != Kind::kGood,
                        .times = 3.5};
    const offline::Run saved = save_run(cell_, measured_, fit);
    const MeasuredOrientations loaded = load_run(cell_, saved.number).fit.orientations;
    EXPECT_EQ(loaded.kind, kind);
    const auto said = orientation_remark(fit.orientations), kept = orientation_remark(loaded);
    ASSERT_EQ(said.has_value(), kept.has_value()) << name_of(kind);
    if (said) {
      EXPECT_EQ(said->message, kept->message);
    }
  }
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
  EXPECT_FALSE(seems_fitted(cell_, measured_));
  const Fit fit = fit_cell(cell_, measured_);
  save_run(cell_, measured_, fit);
  save_run(cell_, measured_, fit);
  EXPECT_EQ(current_run(cell_, measured_)->number, 2);
  // A comment, names, tolerance and [deploy] are nothing that a fit reads; what it reads makes
  // another cell of it, however it is written.
  const auto current = [&](const std::string& old, const std::string& now) {
    std::string text = write_cell(cell_);
    const auto at = text.find(old);
    EXPECT_NE(at, std::string::npos) << old;
    Cell edited = cell_;
    edited.text = text.replace(at, old.size(), now);
    const bool found = current_run(edited, measured_).has_value();
    EXPECT_EQ(seems_fitted(edited, measured_), found) << now;
    return found;
  };
  cell_.text = write_cell(cell_);
  save_run(cell_, measured_, fit);
  EXPECT_TRUE(current("[cell]", "# edited\n[cell]"));
  EXPECT_TRUE(current("tolerance_mm = ", "tolerance_mm = 1"));
  EXPECT_TRUE(current("cycle_us = ", "cycle_us = 1"));
  EXPECT_TRUE(current("name = \"", "name = \"another "));
  EXPECT_TRUE(current("geometry = true", "\"geometry\"  =  true"));
  EXPECT_FALSE(current("seed = ", "seed = 9"));
}

TEST_F(RunStore, ADamagedOrMissingRunIsAnInputErrorAndNeverTheCurrentOne) {
  const offline::Run run = save_run(cell_, measured_, fit_cell(cell_, measured_));
  std::ofstream(run.directory / "run.json") << "{\"schema\": \"run/1\"";
  EXPECT_THROW((void)load_run(cell_, run.number), Failure);
  EXPECT_THROW((void)load_run(cell_, 99), Failure);
  EXPECT_THROW((void)current_run(cell_, measured_), Failure);
  EXPECT_FALSE(seems_fitted(cell_, measured_));
  // A later sound run is found before the damaged one is met.
  save_run(cell_, measured_, run.fit);
  EXPECT_EQ(current_run(cell_, measured_)->number, 2);
}

std::string refusal(const Cell& cell, int number) {
  try {
    (void)load_run(cell, number);
  } catch (const Failure& failure) {
    return failure.problems().front().code + " " + failure.problems().front().message;
  }
  return "loaded";
}

TEST_F(RunStore, EveryChangedOrMissingByteOfARunIsRefusedNamingItsFile) {
  const offline::Run run = save_run(cell_, measured_, fit_cell(cell_, measured_));
  for (const char* name : {"run.json", "predictions.csv"}) {
    const fs::path file = run.directory / name;
    const std::string text = read_file(file);
    const auto put = [&](const std::string& changed) { std::ofstream(file) << changed; };
    for (std::size_t at = 0; at < text.size(); at += text.size() / 97 + 1) {
      std::string changed = text;
      changed[at] = changed[at] == '1' ? '2' : '1';
      put(changed);
      EXPECT_EQ(refusal(cell_, run.number).rfind("E-RUN-DAMAGED ", 0), 0u) << name << " " << at;
      put(text.substr(0, at));
      EXPECT_NE(refusal(cell_, run.number).find(name), std::string::npos) << name << " " << at;
    }
    put(text + "\n");
    EXPECT_NE(refusal(cell_, run.number).find(name), std::string::npos);
    put(text);
    EXPECT_EQ(refusal(cell_, run.number), "loaded");
  }
}

TEST_F(RunStore, WhatIsDamagedIsSaidInPlainWordsWithTheLine) {
  const offline::Run run = save_run(cell_, measured_, fit_cell(cell_, measured_));
  const fs::path file = run.directory / "run.json";
  const std::string text = read_file(file);
  const auto said_of = [&](const std::string& changed) {
    std::ofstream(file) << changed;
    try {
      load_run(cell_, run.number);
    } catch (const Failure& failure) {
      const Problem& problem = failure.problems().front();
      EXPECT_EQ(problem.code, "E-RUN-DAMAGED");
      EXPECT_EQ(problem.message.find("exception"), std::string::npos) << problem.message;
      EXPECT_EQ(problem.message.find("syntax"), std::string::npos) << problem.message;
      EXPECT_NE(problem.help.find("plumb fit"), std::string::npos) << problem.help;
      return problem.message;
    }
    return std::string("loaded");
  };
  const auto has = [](const std::string& message, const std::string& words) {
    return message.find(words) != std::string::npos;
  };
  const auto third = text.find('\n', text.find('\n', text.find('\n') + 1) + 1);
  const std::string cut = said_of(text.substr(0, third - 2));
  EXPECT_TRUE(has(cut, "ends in the middle of line 3")) << cut;
  const std::string changed = said_of(text.substr(0, third + 1) + "}}}" + text.substr(third + 1));
  EXPECT_TRUE(has(changed, "line 4 is no JSON")) << changed;
  EXPECT_TRUE(has(said_of(""), "is empty"));
  auto json = nlohmann::ordered_json::parse(text);
  json.erase("checksum");
  json.erase("predictions_sha256");
  auto lacks = json;
  lacks.erase(std::next(lacks.begin(), 2));
  const std::string lacking = said_of(lacks.dump(1));
  EXPECT_TRUE(has(lacking, "lacks '")) << lacking;
}

TEST_F(RunStore, ARunWithoutCheckSumsOfAnEarlierVersionStillLoads) {
  const offline::Run run = save_run(cell_, measured_, fit_cell(cell_, measured_));
  const fs::path file = run.directory / "run.json";
  EXPECT_TRUE(has_checksums(run.directory));
  auto json = nlohmann::ordered_json::parse(read_file(file));
  json.erase("checksum");
  std::ofstream(file) << json.dump(1);
  EXPECT_NE(refusal(cell_, run.number), "loaded");  // only one of the two was taken out
  json.erase("predictions_sha256");
  std::ofstream(file) << json.dump(1);
  EXPECT_EQ(refusal(cell_, run.number), "loaded");
  EXPECT_FALSE(has_checksums(run.directory));
}

TEST_F(RunStore, DraftsOfDeadProcessesGoAtTheNextRunAndOthersStay) {
  const fs::path runs = folder_ / "runs";
  const pid_t dead = ::fork();
  if (dead == 0) ::_exit(0);
  ::waitpid(dead, nullptr, 0);
  const auto draft = [&](pid_t maker) { return runs / (".draft-" + std::to_string(maker)); };
  for (const pid_t maker : {dead, ::getppid(), ::getpid()}) {
    fs::create_directories(draft(maker));
    std::ofstream(draft(maker) / "predictions.csv.1.tmp") << "half";
  }
  const offline::Run run = save_run(cell_, measured_, fit_cell(cell_, measured_));
  EXPECT_FALSE(fs::exists(draft(dead)));
  EXPECT_FALSE(fs::exists(draft(::getpid())));
  EXPECT_TRUE(fs::exists(draft(::getppid())));
  EXPECT_EQ(std::distance(fs::directory_iterator(run.directory), fs::directory_iterator()), 2);
}

TEST_F(RunStore, AFullDiskLeavesNoDraftAndIsSaidOfTheRun) {
  const Fit fit = fit_cell(cell_, measured_);
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{}, now{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  now = before;
  now.rlim_cur = 1000;
  ::setrlimit(RLIMIT_FSIZE, &now);
  Problem said;
  try {
    save_run(cell_, measured_, fit);
  } catch (const Failure& failure) {
    said = failure.problems().front();
  }
  ::setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(said.code, "E-WRITE");
  EXPECT_EQ(said.message.find(".draft"), std::string::npos) << said.message;
  EXPECT_TRUE(fs::is_empty(folder_ / "runs"));
  EXPECT_EQ(save_run(cell_, measured_, fit).number, 1);
}

}  // namespace
}  // namespace plumb::offline
