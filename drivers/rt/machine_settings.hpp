// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "program/json.hpp"
#include "rt/check.hpp"

namespace plumb::drivers::rt {

/// A file below /etc with settings that a real-time cycle wants.
struct MachineSetting {
  std::filesystem::path file;  // relative to the root of the machine
  std::string text;            // begins with a comment that says who wrote it
  std::string then;            // what makes it take effect
};

/// The settings for this machine: what the kernel grants (sysctl), the limits of users in the group
/// plumb, governor and huge pages, and, to be reviewed by a person before it is renamed, the
/// kernel's command line that isolates a processor. The last one is missing if there is only one
/// processor.
std::vector<MachineSetting> machine_settings(const MachineFiles& files);

/// What no file can change, one sentence each: the kernel, the virtual machine, the firmware.
std::vector<std::string> beyond_settings(const MachineFiles& files, std::span<const Check> checks);

/// What `plumb-rt doctor --fix` did.
struct Fix {
  enum class State : std::uint8_t { kWritten, kWouldWrite, kThereAlready };
  struct File {
    std::filesystem::path path;
    State state = State::kWritten;
    std::string then = {};
  };
  std::vector<File> files;
  std::vector<std::string> beyond;
};

/// "written", "would write", "there already".
const char* to_string(Fix::State state);

enum class FixMode : std::uint8_t { kWrite, kDryRun, kForce };

/// Writes these files below `root`, each completely or not at all. A file with the same content
/// stays as it is. Throws Failure and writes nothing: kUsage (E-EXISTS) if a file has other content
/// and the mode is not kForce, kEnvironment (E-FIX-RIGHTS) if `root` is this machine and the user
/// is not root.
std::vector<Fix::File> write_settings(const std::filesystem::path& root,
                                      std::span<const MachineSetting> settings, FixMode mode);

/// One line per file, and what remains to be done by hand.
std::string to_text(const Fix& fix);

/// {files[{file, state, then}], by_hand[]}
Json to_json(const Fix& fix);

}  // namespace plumb::drivers::rt
