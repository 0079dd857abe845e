// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

#include "program/signing_key.hpp"

namespace plumb {

/// A small text file whose owner and permissions matter. All three are of the file that was opened,
/// so a name that changes meanwhile makes no difference.
struct OwnedText {
  std::string text;
  uid_t owner = 0;
  mode_t mode = 0;
};

/// Throws Failure (kInput, E-READ) if it is missing, unreadable, no regular file or larger than
/// 64 kB. A pipe is not waited for.
OwnedText read_owned_text(const std::filesystem::path& file);

/// Why a file or folder with this owner and mode may hold what others do not control: empty, or
/// "belongs to user 1000, not to root", "may be written by others than its owner". The owner must
/// be root or the user who runs the program.
std::string rights_fault(uid_t owner, mode_t mode);

/// Reads a private key. Throws Failure (kInput): E-READ, E-KEY if it is none, E-KEY-RIGHTS if its
/// group or others may read or write it.
SecretKey read_secret_key(const std::filesystem::path& file);

struct KeyFiles {
  std::filesystem::path secret, shared;
  PublicKey key;
};

/// Makes NAME.key (mode 0600) and NAME.pub with a new pair of keys, or neither. Never replaces a
/// file: throws Failure (kUsage, E-EXISTS), or kEnvironment, E-WRITE.
KeyFiles write_new_keys(const std::filesystem::path& name);

}  // namespace plumb
