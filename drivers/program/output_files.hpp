// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "program/outcome.hpp"
#include "program/verb_options.hpp"

namespace plumb {

/// --force and --dry-run of the verbs that write.
struct WriteOptions {
  bool force = false;
  bool dry_run = false;
  void add_to(VerbOptions& verb);
};

/// Files that belong together: nothing is written unless all may be.
class OutputFiles {
 public:
  /// folder: a folder that the user asked for, such as that of a new cell, and that may be created
  /// without a note. Empty: none.
  explicit OutputFiles(std::filesystem::path folder = {}) : folder_(std::move(folder)) {}

  void add(std::filesystem::path file, std::string bytes);

  /// Refuses names of folders (E-USAGE), names of files that `outcome` keeps or that were read
  /// (refuse_kept) and, without --force, names of existing files (E-EXISTS). For a verb that first
  /// computes for long.
  void check(const WriteOptions& options, const Outcome& outcome) const;

  /// Checks, creates folders, with a note unless the user asked for them, and writes each file
  /// completely or not at all. Adds `files` and `dry_run` to the result, which must be an object.
  void commit(const WriteOptions& options, Outcome& outcome) const;

 private:
  void refuse_folders() const;
  void refuse_existing() const;
  std::vector<Problem> folder_notes(const WriteOptions& options) const;

  std::filesystem::path folder_;
  std::vector<std::pair<std::filesystem::path, std::string>> files_;
};

/// Refuses (kUsage, E-OUTPUT-INPUT) a file that was read as input, or belongs to `outcome.kept`,
/// whatever path names it: --force replaces results, never what they were made from.
void refuse_kept(const std::filesystem::path& file, const Outcome& outcome);

/// N-WRITE-FOLDER if the folder of this file does not exist yet, so that writing makes it.
std::optional<Problem> folder_note(const std::filesystem::path& file, const WriteOptions& options);

/// "wrote x.csv" or, with --dry-run, "would write x.csv".
std::string wrote(const std::filesystem::path& file, const WriteOptions& options);

}  // namespace plumb
