// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "plumb/drivers/session.hpp"

namespace plumb::drivers::rt {

/// What the last run of a folder left, and what this one leaves for the next: whether it ended
/// well, the fault that nobody acknowledged, and the model that an operator has acknowledged. It
/// stands in a small file in $STATE_DIRECTORY, which systemd sets, else in the folder.
///
/// Whatever is not known counts as the worse: without the file, or if it cannot be read or written,
/// an acknowledgement is needed. So it is if others may have written it: its owner must be root or
/// the user who runs, nobody else may write to it or its folder, and in the folder it must have
/// been written by a run of this very folder on this machine, since a folder travels and this file
/// is not signed.
///
/// Slow, for a thread without real-time priority.
class LastRun {
 public:
  /// Reads the file; `model`: SHA-256 of the model that shall run.
  LastRun(const std::filesystem::path& folder, const std::string& model);

  const SessionStart& start() const noexcept { return start_; }

  /// Why an operator must acknowledge before the first correction; empty: that is not needed.
  const std::string& why() const noexcept { return why_; }

  /// Writes that a run has begun. If that is not possible start() needs an acknowledgement.
  void begin();

  /// Writes what has changed: `report` of the session, and the model that runs now.
  void note(const SessionReport& report, const std::string& model);

  /// Writes that the run ended well.
  void end();

  const std::filesystem::path& file() const noexcept { return file_; }

 private:
  struct Content {
    bool ended = false;
    FaultCause fault = FaultCause::kNone;
    std::string acknowledged;  // SHA-256 of a model; empty: none
    bool operator==(const Content&) const = default;
  };

  void read(const std::string& model);
  void need(const std::string& why);
  bool write(const Content& content);

  std::filesystem::path file_;
  bool in_folder_;      // and not in $STATE_DIRECTORY
  std::string folder_;  // then: which folder it is
  SessionStart start_;
  std::string why_;
  Content content_;  // as the file holds it
  bool believed_ = true;
  bool failed_ = false;  // it cannot be written, and is left as it is: the run has not ended well
};

}  // namespace plumb::drivers::rt
