// SPDX-License-Identifier: Apache-2.0
#include "program/sums_signature.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace plumb {
namespace {

constexpr std::string_view kSignatureWord = "plumb-ed25519 ";
constexpr std::string_view kDomain = "plumb deploy folder 1\n";
constexpr std::size_t kKeyIdDigits = 16;

std::string signed_bytes(std::string_view sums) { return std::string(kDomain) + std::string(sums); }

}  // namespace

std::string sign_sums(const SecretKey& key, std::string_view sums) {
  const auto signature = key.sign(signed_bytes(sums));
  return fmt::format("{}{} {}\n", kSignatureWord, key.public_key().id(),
                     base64(signature.data(), signature.size()));
}

SumsSignature read_signature(std::string_view text) {
  if (text.ends_with('\n')) text.remove_suffix(1);
  if (!text.starts_with(kSignatureWord))
    throw std::invalid_argument(fmt::format("it does not begin with '{}'", kSignatureWord));
  text.remove_prefix(kSignatureWord.size());
  const std::string_view id = text.substr(0, kKeyIdDigits);
  if (id.size() < kKeyIdDigits ||
      id.find_first_not_of("0123456789abcdef") != std::string_view::npos ||
      text.size() <= kKeyIdDigits || text[kKeyIdDigits] != ' ')
    throw std::invalid_argument("it names no key by 16 hexadecimal digits");
  SumsSignature out{.key_id = std::string(id), .bytes = {}};
  read_base64(text.substr(kKeyIdDigits + 1), out.bytes.data(), out.bytes.size());
  return out;
}

bool signs(const SumsSignature& signature, const PublicKey& key, std::string_view sums) {
  return key.id() == signature.key_id && verifies(signature.bytes, signed_bytes(sums), key);
}

}  // namespace plumb
