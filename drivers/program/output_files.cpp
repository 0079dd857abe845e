// SPDX-License-Identifier: Apache-2.0
#include "program/output_files.hpp"

#include <fmt/format.h>

#include <set>

#include "program/file.hpp"
#include "program/interrupt.hpp"
#include "program/shell_word.hpp"

namespace plumb {

namespace fs = std::filesystem;

void WriteOptions::add_to(VerbOptions& verb) {
  verb.add_flag("--force", force, "Replace files that are already there");
  verb.add_flag("--dry-run", dry_run, "Do everything but write");
}

void OutputFiles::add(fs::path file, std::string bytes) {
  files_.emplace_back(std::move(file), std::move(bytes));
}

void OutputFiles::refuse_folders() const {
  std::vector<Problem> problems;
  for (const auto& [file, bytes] : files_) {
    std::error_code ignored;
    if (!file.filename().empty() && !fs::is_directory(file, ignored)) continue;
    problems.push_back(
        {.code = "E-USAGE",
         .message = fmt::format("{} is a folder, and a file is to be written", file.string()),
         .help = "add the name of the file"});
  }
  if (!problems.empty()) throw Failure(Exit::kUsage, std::move(problems));
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

std::vector<Problem> OutputFiles::folder_notes(const WriteOptions& options) const {
  std::vector<Problem> out;
  if (!folder_.empty()) return out;
  std::set<std::string> said;
  for (const auto& [file, bytes] : files_)
    if (auto note = folder_note(file, options); note && said.insert(note->message).second)
      out.push_back(std::move(*note));
  return out;
}

std::optional<Problem> folder_note(const fs::path& file, const WriteOptions& options) {
  std::error_code ignored;
  fs::path made;  // the uppermost folder that is not there
  for (fs::path folder = file.parent_path(); !folder.empty() && !fs::exists(folder, ignored);
       folder = folder.parent_path())
    made = folder;
  if (made.empty()) return std::nullopt;
  return Problem{.severity = Severity::kNote,
                 .code = "N-WRITE-FOLDER",
                 .message = fmt::format("there was no folder {}: {}", display_name(made),
                                        options.dry_run ? "it would be made" : "it was made"),
                 .help = "ls " + shell_word(display_name(made))};
}

namespace {

/// Whether it is that file, or lies in that folder.
bool belongs_to(const fs::path& file, const fs::path& kept) {
  std::error_code ignored;
  if (fs::equivalent(file, kept, ignored)) return true;
  if (!fs::is_directory(kept, ignored)) return false;
  fs::path folder = fs::weakly_canonical(file, ignored).parent_path();
  for (; folder.has_relative_path(); folder = folder.parent_path())
    if (fs::equivalent(folder, kept, ignored)) return true;
  return false;
}

}  // namespace

void refuse_kept(const fs::path& file, const Outcome& outcome) {
  if (!would_replace(file)) return;
  const auto refuse = [&](const char* why) {
    throw Failure(Exit::kUsage,
                  {.code = "E-OUTPUT-INPUT",
                   .message = fmt::format("{} would be replaced, and {}", display_name(file), why),
                   .help = "name another file to write"});
  };
  for (const InputFile& input : outcome.inputs)
    if (belongs_to(file, input.file)) refuse("this command reads it");
  for (const fs::path& kept : outcome.kept)
    if (belongs_to(file, kept)) refuse("it is what this command works on, not what it makes");
}

void OutputFiles::check(const WriteOptions& options, const Outcome& outcome) const {
  refuse_folders();
  for (const auto& [file, bytes] : files_) refuse_kept(file, outcome);
  if (!options.force) refuse_existing();
}

void OutputFiles::commit(const WriteOptions& options, Outcome& outcome) const {
  check(options, outcome);
  Json names = Json::array();
  for (const auto& [file, bytes] : files_) names.push_back(file.string());
  outcome.result["files"] = names;
  outcome.result["dry_run"] = options.dry_run;
  const std::vector<Problem> notes = folder_notes(options);
  if (options.dry_run) return outcome.remark(notes);
  const Writing writing;
  for (const auto& [file, bytes] : files_) {
    if (file.has_parent_path()) fs::create_directories(file.parent_path());
    write_new_file(file, bytes, options.force ? Overwrite::kForce : Overwrite::kNo);
  }
  outcome.remark(notes);
}

std::string wrote(const fs::path& file, const WriteOptions& options) {
  return fmt::format("{} {}", options.dry_run ? "would write" : "wrote", file.string());
}

}  // namespace plumb
