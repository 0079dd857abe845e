// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "plumb/drivers/bus_message.hpp"
#include "rt/line_file.hpp"

namespace plumb::drivers::rt {

/// Corrected targets as a CSV file: t_s,counter,cx_mm … cqz. It ends with a whole line, also when
/// the disk is full.
class AnswerFile {
 public:
  /// An existing file is not replaced. Throws Failure (kEnvironment, E-RT-SINK).
  explicit AnswerFile(const std::filesystem::path& file);
  /// Throws what the constructor would throw, without creating a file.
  static void check(const std::filesystem::path& file);

  /// Messages of other kinds are ignored.
  void add(const BusMessage& corrected);

  /// Writes what was added. Returns the errno of the first line that did not reach the file, and no
  /// line after it does; 0: all are there.
  int write();

  const std::filesystem::path& file() const noexcept { return out_.file(); }

 private:
  LineFile out_;
};

}  // namespace plumb::drivers::rt
