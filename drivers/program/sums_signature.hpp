// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "program/signing_key.hpp"

namespace plumb {

/// The list of check sums of a deploy folder, and its detached signature.
inline constexpr char kSumsFile[] = "SHA256SUMS";
inline constexpr char kSignatureFile[] = "SHA256SUMS.sig";

/// The signature of a whole deploy folder: Ed25519 over the line "plumb deploy folder 1\n" followed
/// by the bytes of SHA256SUMS, which names every file. The first line keeps a signature that the
/// same key made of anything else from standing for a folder.
///
/// The signature as one line of text: "plumb-ed25519 KEY-ID BASE64", with the id of the key that
/// made it.
struct SumsSignature {
  std::string key_id;
  std::array<unsigned char, 64> bytes{};
};

/// The line of SHA256SUMS.sig.
std::string sign_sums(const SecretKey& key, std::string_view sums);

/// Throws std::invalid_argument with the reason if the text is no signature.
SumsSignature read_signature(std::string_view text);

/// Whether this key made the signature of these sums.
bool signs(const SumsSignature& signature, const PublicKey& key, std::string_view sums);

}  // namespace plumb
