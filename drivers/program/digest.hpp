// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace plumb {

/// SHA-256 of bytes that come piece by piece.
class Digest {
 public:
  Digest();
  ~Digest();
  Digest(const Digest&) = delete;
  Digest& operator=(const Digest&) = delete;

  void add(std::string_view bytes);

  /// 64 lower-case hex digits; once, at the end.
  std::string text();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace plumb
