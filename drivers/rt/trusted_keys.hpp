// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "program/problem.hpp"
#include "program/signing_key.hpp"

namespace plumb::drivers::rt {

/// A key that this machine knows, by the name of its file without the ending.
struct KnownKey {
  std::string name;
  PublicKey key;
  enum class Trust : std::uint8_t { kTrusted, kRevoked } trust = Trust::kTrusted;
};

/// The content of /etc/plumb/keys.d: NAME.pub are trusted, NAME.revoked are known only so that they
/// can be refused by name. A key that is both is revoked. A file that is no key, or that others
/// than its owner may write, or that belongs to someone else than root or the user who runs the
/// program, is a problem (E-RT-KEYS) and not used; the other files still count.
struct TrustedKeys {
  std::vector<KnownKey> keys;
  std::vector<Problem> problems;

  /// The key with this id, revoked if any file says so; null if there is none.
  const KnownKey* find(const std::string& id) const;
};

/// Reads the folder, whose own owner and permissions are judged in the same way. Slow.
TrustedKeys read_trusted_keys(const std::filesystem::path& folder);

/// E-RT-KEYS, "FILE is not used: it FAULT", or nothing if the fault is empty.
std::vector<Problem> rights_problem(const std::filesystem::path& file, const std::string& fault);

}  // namespace plumb::drivers::rt
