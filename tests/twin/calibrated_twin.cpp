// SPDX-License-Identifier: Apache-2.0
#include "tests/twin/calibrated_twin.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <variant>

#include "plumb/format/reader.hpp"

namespace plumb::offline::twin {
namespace {

namespace fs = std::filesystem;

void must_run(const std::string& command) {
  std::string all;
  std::FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  char buffer[4096];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, pipe)) all.append(buffer, n);
  ASSERT_EQ(::pclose(pipe), 0) << command << "\n" << all;
}

fs::path new_folder() {
  std::string name = (fs::temp_directory_path() / "plumb-twin-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  return name;
}

std::shared_ptr<const LoadedModel> load(const fs::path& file) {
  auto read = format::read_model(file);
  if (!std::holds_alternative<format::Model>(read)) return nullptr;
  return LoadedModel::make(std::get<format::Model>(std::move(read)));
}

}  // namespace

CalibratedTwin::CalibratedTwin(const std::string& words) : folder_(new_folder()) {
  const std::string at = " '" + folder_.string() + "' ";
  must_run(std::string(PLUMB_TWIN_PROGRAM) + " new" + at + words);
  must_run(std::string(PLUMB_TWIN_PROGRAM) + " measure" + at);
  must_run(std::string(PLUMB_PROGRAM) + " -C" + at + "diagnose --apply");
  must_run(std::string(PLUMB_PROGRAM) + " -C" + at + "compile");
  Outcome outcome;
  auto opened = open_folder(folder_, outcome);
  cell_ = std::move(opened.cell);
  hidden_ = std::move(opened.hidden);
  truth_ = truth_of(cell_, hidden_);
  model_ = load(folder_ / "robot.plumb");
  if (model_ == nullptr) throw std::runtime_error("no model in " + folder_.string());
}

CalibratedTwin::~CalibratedTwin() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

const CalibratedTwin& CalibratedTwin::usual() {
  static const CalibratedTwin twin;
  return twin;
}

}  // namespace plumb::offline::twin
