// SPDX-License-Identifier: Apache-2.0
#include "program/signing_key.hpp"

#include <fmt/format.h>
#include <sodium.h>

#include <stdexcept>

#include "program/file.hpp"
#include "program/problem.hpp"

namespace plumb {
namespace {

constexpr std::string_view kPublicWord = "plumb-ed25519", kSecretWord = "plumb-ed25519-secret";
constexpr std::size_t kIdDigits = 16, kMostComment = 200;

static_assert(crypto_sign_PUBLICKEYBYTES == 32 && crypto_sign_SEEDBYTES == 32 &&
              crypto_sign_SECRETKEYBYTES == 64 && crypto_sign_BYTES == 64);

/// The library chooses its code for this processor; the first call counts, others do nothing.
void start_library() {
  if (::sodium_init() < 0)
    throw Failure(Exit::kBug, Problem{.code = "E-BUG", .message = "libsodium does not start"});
}

struct KeyLine {
  std::string_view base64;
  std::string comment;
};

/// The parts of "WORD BASE64 comment"; the comment may be missing.
KeyLine split(std::string_view text, std::string_view word) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r' || text.back() == ' '))
    text.remove_suffix(1);
  if (text.find('\n') != std::string_view::npos)
    throw std::invalid_argument("it has more than one line");
  if (text.empty()) throw std::invalid_argument("it is empty");
  if (word == kPublicWord && text.starts_with(kSecretWord))
    throw std::invalid_argument("it is a private key, which belongs on no other machine");
  if (!text.starts_with(word) || text.size() <= word.size() || text[word.size()] != ' ')
    throw std::invalid_argument(fmt::format("it does not begin with '{} '", word));
  text.remove_prefix(word.size() + 1);
  const std::size_t end = text.find(' ');
  KeyLine out{.base64 = text.substr(0, end), .comment = {}};
  if (end == std::string_view::npos) return out;
  out.comment = text.substr(end + 1, kMostComment);
  for (char& c : out.comment)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return out;
}

}  // namespace

std::string base64(const unsigned char* bytes, std::size_t size) {
  std::string out(sodium_base64_encoded_len(size, sodium_base64_VARIANT_ORIGINAL), '\0');
  ::sodium_bin2base64(out.data(), out.size(), bytes, size, sodium_base64_VARIANT_ORIGINAL);
  out.pop_back();  // the zero at the end
  return out;
}

void read_base64(std::string_view text, unsigned char* bytes, std::size_t size) {
  std::size_t got = 0;
  const char* end = nullptr;
  const bool read = ::sodium_base642bin(bytes, size, text.data(), text.size(), nullptr, &got, &end,
                                        sodium_base64_VARIANT_ORIGINAL) == 0;
  if (!read || got != size || end != text.data() + text.size() || base64(bytes, size) != text)
    throw std::invalid_argument(fmt::format("it has no {} bytes in base64", size));
}

std::string PublicKey::id() const {
  return sha256({reinterpret_cast<const char*>(bytes.data()), bytes.size()}).substr(0, kIdDigits);
}

std::string PublicKey::text() const {
  return fmt::format("{} {}{}{}\n", kPublicWord, base64(bytes.data(), bytes.size()),
                     comment.empty() ? "" : " ", comment);
}

PublicKey read_public_key(std::string_view text) {
  const KeyLine line = split(text, kPublicWord);
  PublicKey out{.bytes = {}, .comment = line.comment};
  read_base64(line.base64, out.bytes.data(), out.bytes.size());
  return out;
}

SecretKey::SecretKey(const std::array<unsigned char, 32>& seed) : seed_(seed) {
  start_library();
  std::array<unsigned char, 32> ignored{};
  ::crypto_sign_seed_keypair(ignored.data(), key_.data(), seed_.data());
}

SecretKey::SecretKey(SecretKey&& other) noexcept : seed_(other.seed_), key_(other.key_) {
  ::sodium_memzero(other.seed_.data(), other.seed_.size());
  ::sodium_memzero(other.key_.data(), other.key_.size());
}

SecretKey::~SecretKey() {
  ::sodium_memzero(seed_.data(), seed_.size());
  ::sodium_memzero(key_.data(), key_.size());
}

SecretKey SecretKey::generate() {
  start_library();
  std::array<unsigned char, 32> seed{};
  ::randombytes_buf(seed.data(), seed.size());
  SecretKey out(seed);
  ::sodium_memzero(seed.data(), seed.size());
  return out;
}

SecretKey SecretKey::read(std::string_view text) {
  const KeyLine line = split(text, kSecretWord);
  std::array<unsigned char, 32> seed{};
  read_base64(line.base64, seed.data(), seed.size());
  SecretKey out(seed);
  ::sodium_memzero(seed.data(), seed.size());
  return out;
}

PublicKey SecretKey::public_key() const {
  PublicKey out;
  ::crypto_sign_ed25519_sk_to_pk(out.bytes.data(), key_.data());
  return out;
}

std::string SecretKey::text(const std::string& comment) const {
  return fmt::format("{} {}{}{}\n", kSecretWord, base64(seed_.data(), seed_.size()),
                     comment.empty() ? "" : " ", comment);
}

std::array<unsigned char, 64> SecretKey::sign(std::string_view bytes) const {
  std::array<unsigned char, 64> out{};
  ::crypto_sign_detached(out.data(), nullptr, reinterpret_cast<const unsigned char*>(bytes.data()),
                         bytes.size(), key_.data());
  return out;
}

bool verifies(const std::array<unsigned char, 64>& signature, std::string_view bytes,
              const PublicKey& key) {
  start_library();
  return ::crypto_sign_verify_detached(signature.data(),
                                       reinterpret_cast<const unsigned char*>(bytes.data()),
                                       bytes.size(), key.bytes.data()) == 0;
}

}  // namespace plumb
