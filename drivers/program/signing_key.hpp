// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace plumb {

/// An Ed25519 public key [RFC 8032], and the comment that follows it in its file.
struct PublicKey {
  std::array<unsigned char, 32> bytes{};
  std::string comment = {};

  /// The first 16 hexadecimal digits of the SHA-256 of the 32 bytes.
  std::string id() const;

  /// The line of its file: "plumb-ed25519 BASE64 comment".
  std::string text() const;
};

/// Reads the one line of a public key's file. Throws std::invalid_argument with the reason.
PublicKey read_public_key(std::string_view text);

/// An Ed25519 private key. Its memory is wiped at the end.
class SecretKey {
 public:
  static SecretKey generate();

  /// Reads the one line of a private key's file, "plumb-ed25519-secret BASE64 comment"; BASE64: the
  /// seed of 32 bytes. Throws std::invalid_argument with the reason.
  static SecretKey read(std::string_view text);

  ~SecretKey();
  SecretKey(SecretKey&& other) noexcept;
  SecretKey(const SecretKey&) = delete;
  SecretKey& operator=(const SecretKey&) = delete;

  PublicKey public_key() const;

  /// The line of its file.
  std::string text(const std::string& comment) const;

  std::array<unsigned char, 64> sign(std::string_view bytes) const;

 private:
  explicit SecretKey(const std::array<unsigned char, 32>& seed);

  std::array<unsigned char, 32> seed_{};
  std::array<unsigned char, 64> key_{};  // as the library wants it: the seed and the public key
};

/// Whether this is the signature of the bytes by this key. The time depends on the number of bytes
/// alone.
bool verifies(const std::array<unsigned char, 64>& signature, std::string_view bytes,
              const PublicKey& key);

/// Base64 with padding, and back [RFC 4648]. Reading throws std::invalid_argument unless the text
/// is the canonical encoding of exactly `size` bytes.
std::string base64(const unsigned char* bytes, std::size_t size);
void read_base64(std::string_view text, unsigned char* bytes, std::size_t size);

}  // namespace plumb
