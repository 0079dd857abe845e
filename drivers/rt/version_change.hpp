// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rt/install_history.hpp"
#include "rt/place.hpp"
#include "rt/running_place.hpp"

namespace plumb::drivers::rt {

/// How the version of a place that is current is changed.
struct ChangeRequest {
  InstallPlace place;
  std::string etc;        // folder of the machine's settings
  double change_m = 0.0;  // the change of corrections that the operator allows; 0: that of rt.toml
  enum class Running : std::uint8_t {
    kSwap,    // a plumb-rt that runs goes on with the new model at once, or nothing changes
    kRestart  // it runs on as it is until it is started again
  } running = Running::kSwap;
};

/// What an install or a rollback has done.
struct Changed {
  HistoryLine line;
  bool nothing = false;              // the version was current, and runs if anything does
  double change_mm = 0.0;            // by which the swap changes corrections; 0 without one
  std::vector<std::string> removed;  // versions that were too old to keep
};

/// What is known of a place before it is changed.
struct PlaceBefore {
  std::string current;  // version; empty: none
  History history;
};

/// The change of a place from one current version to another, which stands there already. The
/// caller holds the lock of the store (version_store.hpp).
///
/// Order: the link is prepared, the line of the history is written, what runs swaps, the link is
/// renamed. So a disk that is full is noticed while nothing has changed, what a plumb-rt refuses
/// never becomes current, and no change is without its line.
class VersionChange {
 public:
  /// `line`: what shall become current, but for `how`. Looks for a plumb-rt that runs the place;
  /// throws Failure as find_running() does.
  VersionChange(const ChangeRequest& request, const PlaceBefore& before, HistoryLine line);

  /// Throws Failure: E-RT-RESTART, E-WRITE, and what the running plumb-rt answers. Then nothing has
  /// changed but the history, which says so. Slow.
  Changed make();

  /// The version that runs; empty if none does, or if that is not known.
  std::string running() const { return running_ ? running_->version : ""; }

 private:
  SwapRequest swap_to(const std::string& id, double change_m) const;
  void refuse_if_restart() const;
  void commit(CurrentLink& link, bool swapped) const;
  void take_back(const std::string& why) const noexcept;

  const ChangeRequest& request_;
  const PlaceBefore& before_;
  HistoryLine line_;
  std::optional<RunningPlace> running_;
  bool runs_ = false;
};

}  // namespace plumb::drivers::rt
