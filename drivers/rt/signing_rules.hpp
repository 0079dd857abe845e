// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "program/verb_options.hpp"
#include "rt/trusted_keys.hpp"

namespace plumb::drivers::rt {

/// What this machine demands of a deploy folder before it runs it.
///
/// Signatures are demanded as soon as the folder keys.d is there, even if it is empty. Then a
/// folder runs without one only if plumb-rt.toml beside it says `unsigned = "allowed"`. A machine
/// without keys.d, such as a developer's, demands none, and says so in status, doctor and journal.
struct SigningRules {
  std::filesystem::path etc;  // the folder of this machine's settings
  enum class Unsigned : std::uint8_t {
    kRefused,
    kAllowed,  // by plumb-rt.toml
    kNoKeys    // there is no keys.d
  } unsigned_folders = Unsigned::kRefused;
  TrustedKeys keys;

  bool demanded() const { return unsigned_folders != Unsigned::kNoKeys; }

  /// What must be said again and again of a folder that runs without a signature; empty with
  /// kRefused.
  std::string unsigned_note() const;
};

/// The folder of this machine's settings. Another one is named only by an option of the command
/// line, never by the environment: who may choose the options of a command may as well start
/// another program, but an environment may come from elsewhere.
inline constexpr char kEtc[] = "/etc/plumb";

/// Adds the option that names another folder, for tests and for machines that are prepared.
void add_etc_option(VerbOptions& verb, std::string& etc);

/// Reads keys.d and plumb-rt.toml. Throws Failure (kInput) if plumb-rt.toml cannot be trusted or
/// read: E-RT-KEYS, E-TOML, E-RT-KEY, E-RT-RANGE. Slow.
SigningRules read_signing_rules(const std::filesystem::path& etc);

/// The problems of keys.d as warnings (W-RT-KEYS), for a folder that may run all the same.
std::vector<Problem> key_warnings(const SigningRules& rules);

}  // namespace plumb::drivers::rt
