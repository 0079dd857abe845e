// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "rt/signing_rules.hpp"

namespace plumb::drivers::rt {

/// Who made a deploy folder, as far as this machine can tell.
struct Origin {
  std::string key;     // name of the trusted key that signed it; empty: its signature is not known
  std::string key_id;  // of the key that its signature names; empty: it is unsigned
  std::string note;    // why it runs although no trusted key signed it; empty if one did
};

/// Judges the signature of the folder's SHA256SUMS, whose content `sums` is. Where signatures are
/// demanded, or the folder has one that can be checked, throws Failure (kInput):
///   E-RT-UNSIGNED   it has none, and the rules do not allow that
///   E-RT-SIGNER     a key signed it that this machine does not know
///   E-RT-REVOKED    a key signed it that is revoked
///   E-RT-SIGNATURE  SHA256SUMS.sig is no signature, or does not belong to this SHA256SUMS
/// The files themselves are compared with the sums elsewhere. Slow.
Origin find_origin(const std::filesystem::path& folder, const std::string& sums,
                   const SigningRules& rules);

/// What may stand in a deploy folder beside the files that SHA256SUMS lists.
enum class Beside : std::uint8_t {
  kRunFiles,  // what plumb-rt itself writes there: journal, state, snapshots, socket, `written`
  kNothing,   // nothing: it is a version of a place
};

/// Throws Failure (kInput, E-RT-FOLDER) unless everything in the folder is listed by `sums`, or one
/// of the signature's own files, or allowed beside them, every listed name lies in the folder, and
/// all of it is made of folders and regular files with a single name: no symbolic links, hard links
/// or pipes. `written`: files that rt.toml lets plumb-rt write. Slow.
void check_content(const std::filesystem::path& folder, const std::string& sums, Beside beside,
                   const std::vector<std::filesystem::path>& written);

}  // namespace plumb::drivers::rt
