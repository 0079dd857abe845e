// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

#include "program/file.hpp"

namespace plumb {

/// A long output that is written as it is made and appears whole or not at all.
///
/// The bytes go to a file without a name, so that nothing is left behind however the program ends.
/// `commit` gives it the name; where a file cannot be named, as for stdout, a pipe or a device, it
/// copies the bytes. Memory: one buffer. Not for several threads at once.
/// Throws Failure (kEnvironment, E-WRITE) with the system's reason.
class Spool {
 public:
  /// An empty name is stdout.
  explicit Spool(std::filesystem::path file);
  ~Spool();
  Spool(const Spool&) = delete;
  Spool& operator=(const Spool&) = delete;

  void write(std::string_view bytes);

  /// Makes folders; replaces a file only with kForce, else throws Failure (kUsage, E-EXISTS). What
  /// is replaced keeps its permissions.
  void commit(Overwrite overwrite);

 private:
  void commit_to_stream();
  void commit_to_file(Overwrite overwrite);
  int give_name(const std::filesystem::path& draft, const std::filesystem::path& target) const;
  int copy_to(int fd) const;

  std::filesystem::path file_;
  int fd_ = -1;
};

}  // namespace plumb
