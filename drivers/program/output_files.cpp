// SPDX-License-Identifier: Apache-2.0
#include "program/output_files.hpp"

#include <fmt/format.h>

#include "program/file.hpp"
#include "program/interrupt.hpp"

namespace plumb {

namespace fs = std::filesystem;

void WriteOptions::add_to(CLI::App& verb) {
  verb.add_flag("--force", force, "Replace files that are already there");
  verb.add_flag("--dry-run", dry_run, "Do everything but write");
}

void OutputFiles::add(fs::path file, std::string bytes) {
  files_.emplace_back(std::move(file), std::move(bytes));
}

void OutputFiles::refuse_existing() const {
  std::vector<Problem> problems;
  for (const auto& [file, bytes] : files_)
    if (would_replace(file))
      problems.push_back({.code = "E-EXISTS",
                          .message = fmt::format("{} is already there", file.string()),
                          .help = "to replace it add --force"});
  if (!problems.empty()) throw Failure(Exit::kUsage, std::move(problems));
}

void OutputFiles::commit(const WriteOptions& options, Outcome& outcome) const {
  if (!options.force) refuse_existing();
  Json names = Json::array();
  for (const auto& [file, bytes] : files_) names.push_back(file.string());
  outcome.result["files"] = names;
  outcome.result["dry_run"] = options.dry_run;
  if (options.dry_run) return;
  const Writing writing;
  for (const auto& [file, bytes] : files_) {
    if (file.has_parent_path()) fs::create_directories(file.parent_path());
    write_new_file(file, bytes, options.force ? Overwrite::kForce : Overwrite::kNo);
  }
}

std::string wrote(const fs::path& file, const WriteOptions& options) {
  return fmt::format("{} {}", options.dry_run ? "would write" : "wrote", file.string());
}

}  // namespace plumb
