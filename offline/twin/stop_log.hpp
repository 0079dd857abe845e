// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "twin/controller.hpp"
#include "twin/twin_file.hpp"

namespace plumb::offline::twin {

/// Writes a line of CSV for every stop while the path is driven, so that others can watch: station,
/// time [s], settled, correction [mm], true error without correction (empty if that was not driven)
/// and with it [mm]. A thread of its own computes the errors, apart from the cycle; each line is
/// there at once and whole.
class StopLog {
 public:
  /// What the errors are computed from; outlives the log.
  struct Arm {
    const Cell& cell;
    const Hidden& hidden;
    const HiddenTruth& truth;
    int stations;
    const std::vector<double>& off_m;  // true errors without correction, or empty
  };

  /// Replaces the file. Throws Failure (kEnvironment, E-WRITE) if it cannot be written, and
  /// what true_errors does.
  StopLog(const std::filesystem::path& file, const Arm& arm);
  ~StopLog();
  StopLog(const StopLog&) = delete;
  StopLog& operator=(const StopLog&) = delete;

  /// Hands over the stops so far. Copies the new ones and returns: cheap enough for the cycle.
  void look(const std::vector<Stop>& stops);

  /// Waits for the last line. Throws Failure (kEnvironment, E-WRITE) if one could not be written.
  void finish();

 private:
  void run();
  void write(const std::vector<Stop>& stops, std::size_t written);

  const std::filesystem::path file_;
  const Arm arm_;
  std::ofstream out_;
  std::mutex mutex_;
  std::condition_variable news_;
  std::vector<Stop> stops_;
  bool ended_ = false;
  std::thread thread_;
};

}  // namespace plumb::offline::twin
