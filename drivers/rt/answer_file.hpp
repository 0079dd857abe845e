// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <filesystem>

#include "plumb/drivers/bus_message.hpp"

namespace plumb::drivers::rt {

/// Corrected targets as a CSV file: t_s,counter,cx_mm … cqz.
class AnswerFile {
 public:
  /// An existing file is not replaced. Throws Failure (kEnvironment, E-RT-SINK).
  explicit AnswerFile(const std::filesystem::path& file);
  /// Throws what the constructor would throw, without creating a file.
  static void check(const std::filesystem::path& file);
  ~AnswerFile();
  AnswerFile(const AnswerFile&) = delete;
  AnswerFile& operator=(const AnswerFile&) = delete;

  /// Messages of other kinds are ignored.
  void add(const BusMessage& corrected);

  /// True if every line so far has reached the file.
  bool sound() const noexcept { return sound_; }

 private:
  std::FILE* file_;
  bool sound_ = true;
};

}  // namespace plumb::drivers::rt
