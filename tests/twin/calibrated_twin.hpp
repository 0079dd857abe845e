// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "plumb/runtime/loaded_model.hpp"
#include "twin/twin_file.hpp"

namespace plumb::offline::twin {

/// A twin made, measured, diagnosed and compiled as a user does it, by the programs themselves.
class CalibratedTwin {
 public:
  /// `words`: further options of plumb-twin new. Fails the test if a program does.
  explicit CalibratedTwin(const std::string& words = "");
  ~CalibratedTwin();
  CalibratedTwin(const CalibratedTwin&) = delete;
  CalibratedTwin& operator=(const CalibratedTwin&) = delete;

  /// The one of all tests that do not ask for another.
  static const CalibratedTwin& usual();

  const std::filesystem::path& folder() const { return folder_; }
  const Cell& cell() const { return cell_; }
  const Hidden& hidden() const { return hidden_; }
  const HiddenTruth& truth() const { return truth_; }
  const LoadedModel& model() const { return *model_; }

 private:
  std::filesystem::path folder_;
  Cell cell_;
  Hidden hidden_;
  HiddenTruth truth_;
  std::shared_ptr<const LoadedModel> model_;
};

}  // namespace plumb::offline::twin
