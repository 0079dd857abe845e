// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>

namespace plumb::offline::cli {

/// Longer than any calibration that plumb makes in one go is expected to take.
inline constexpr std::chrono::seconds kLongestLockWait{600};

/// Keeps every other plumb process from changing the cell in `folder` until this process ends, so
/// that what is read, changed and written back is one step. The lock is advisory (flock) and stands
/// on the folder itself: nothing is written, and it ends with the process, however that ends. A
/// second call for the same folder does nothing. Waits while another plumb holds it, and says so on
/// stderr after a second; throws Failure (kEnvironment, E-CELL-BUSY) after `longest`. A file system
/// without locks is worked in without one.
void lock_cell(const std::filesystem::path& folder,
               std::chrono::milliseconds longest = kLongestLockWait);

}  // namespace plumb::offline::cli
