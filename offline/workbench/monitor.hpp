// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>

#include "program/json.hpp"
#include "workbench/child.hpp"
#include "workbench/services.hpp"

namespace plumb::offline::workbench {

/// A running `plumb-rt` as the page shows it, and, for those without a robot, plumb-rt and
/// plumb-twin started beside each other. Both programs lie beside `plumb`. Folders are those that
/// `plumb deploy` wrote, directly in the folder of the cell. From any thread.
class Monitor {
 public:
  Monitor(std::filesystem::path cell_folder, const std::atomic<bool>& stop);
  ~Monitor();

  /// {running, twin, folder, folders, status, limits, stops, twin_command, problem}; `folder`
  /// empty: the first one. `stops`: what the twin of the last start has driven, with its true
  /// errors; null if none was started here.
  std::string look(const std::string& folder);

  /// Starts or stops plumb-rt, as an ordinary thread without real-time rights, and the twin whose
  /// twin.toml lies beside cell.toml. Returns what `look` does.
  std::string drive(const std::string& folder, Services::Drive what);

 private:
  void start(const std::string& folder);
  Json limits_of(const std::filesystem::path& deployed);

  const std::filesystem::path cell_folder_;
  const std::atomic<bool>& stop_;
  std::mutex mutex_;
  std::unique_ptr<Child> rt_, twin_;
  std::string rt_says_, twin_says_;
  std::filesystem::path stops_;  // where the twin writes them; empty before the first start
  std::string model_stamp_;      // of the model file whose limits these are
  Json model_limits_;
};

}  // namespace plumb::offline::workbench
