// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

namespace plumb::drivers::rt {

/// [record] of rt.toml: what of a run is kept, and how much of the disk that may take.
struct RecordSettings {
  std::filesystem::path file = {};  // [log] record; empty: no record
  int max_file_mb = 100;            // [1e6 bytes]; a quarter of max_total_mb at most
  int max_total_mb = 1000;          // of all files of the record; 0: no limit
  int max_age_days = 30;            // 0: no limit
  int free_space_floor_mb = 200;    // the record leaves so much of the disk free
  int snapshots = 10;               // kept of faults, and as many of holds; 0: none are made
  double before_s = 10.0;           // what a snapshot holds before a fault, at least
  double after_s = 5.0;             // and after it

  bool operator==(const RecordSettings&) const = default;

  std::uint64_t file_bytes() const noexcept {
    const std::uint64_t most = kMega * static_cast<std::uint64_t>(max_file_mb);
    const std::uint64_t quarter = total_bytes() / 4;
    return quarter > 0 && quarter < most ? quarter : most;
  }
  std::uint64_t total_bytes() const noexcept {
    return kMega * static_cast<std::uint64_t>(max_total_mb);
  }
  std::uint64_t floor_bytes() const noexcept {
    return kMega * static_cast<std::uint64_t>(free_space_floor_mb);
  }

 private:
  static constexpr std::uint64_t kMega = 1'000'000;
};

}  // namespace plumb::drivers::rt
