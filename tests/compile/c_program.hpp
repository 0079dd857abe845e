// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace plumb::tests {

/// One emitted header: the name of its file, the name its symbols begin with, its text.
struct CHeader {
  std::string file, prefix, text;
};

/// Compilers and flags that users will have.
inline constexpr char kStrictC[] =
    "cc -std=c99 -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror -ffp-contract=off";
inline constexpr char kStrictCpp[] =
    "c++ -x c++ -std=c++11 -Wall -Wextra -Wpedantic -Wconversion -Wold-style-cast -Werror "
    "-ffp-contract=off";

/// Headers compiled into one program, without a C library, by `compiler`; then loaded.
class CProgram {
 public:
  CProgram(const std::vector<CHeader>& headers, const std::string& compiler);
  ~CProgram();
  CProgram(const CProgram&) = delete;
  CProgram& operator=(const CProgram&) = delete;

  /// What the compiler had to say; empty if it took everything without a word.
  const std::string& complaint() const { return complaint_; }

  struct Answer {
    int status = -99;
    std::array<double, 3> error_m{};
  };

  /// What header `k` says at q, shape (n,).
  Answer operator()(int k, std::span<const double> q) const;

 private:
  std::filesystem::path folder_;
  std::string complaint_;
  void* library_ = nullptr;
  int (*evaluate_)(int, const double*, double*) = nullptr;
};

}  // namespace plumb::tests
