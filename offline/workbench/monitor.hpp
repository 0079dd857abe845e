// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>

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

  /// {running, twin, folder, folders, status, limits, problem}; `folder` empty: the first one.
  std::string look(const std::string& folder);

  /// Starts or stops plumb-rt, as an ordinary thread without real-time rights, and the twin whose
  /// twin.toml lies beside cell.toml. Returns what `look` does.
  std::string drive(const std::string& folder, Services::Drive what);

 private:
  void start(const std::string& folder);

  const std::filesystem::path cell_folder_;
  const std::atomic<bool>& stop_;
  std::mutex mutex_;
  std::unique_ptr<Child> rt_, twin_;
  std::string rt_says_, twin_says_;
};

}  // namespace plumb::offline::workbench
