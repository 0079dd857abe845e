// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "program/outcome.hpp"

namespace plumb {

/// --force and --dry-run of the verbs that write.
struct WriteOptions {
  bool force = false;
  bool dry_run = false;
  void add_to(CLI::App& verb);
};

/// Files that belong together: nothing is written unless all may be.
class OutputFiles {
 public:
  void add(std::filesystem::path file, std::string bytes);

  /// Refuses (E-EXISTS) to replace a file without --force, makes folders, writes each file all or
  /// nothing. Adds `files` and `dry_run` to the result, which must be an object.
  void commit(const WriteOptions& options, Outcome& outcome) const;

 private:
  void refuse_existing() const;

  std::vector<std::pair<std::filesystem::path, std::string>> files_;
};

/// "wrote x.csv" or, with --dry-run, "would write x.csv".
std::string wrote(const std::filesystem::path& file, const WriteOptions& options);

}  // namespace plumb
