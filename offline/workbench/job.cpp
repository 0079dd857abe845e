// SPDX-License-Identifier: Apache-2.0
#include "workbench/job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "program/printable.hpp"
#include "program/problem.hpp"
#include "program/shell_word.hpp"
#include "workbench/names.hpp"

namespace plumb::offline::workbench {
namespace {

constexpr std::size_t kMostArgs = 64, kLongestArg = 4096;

constexpr std::array<std::string_view, 21> kVerbs{
    "check", "import", "fit",  "compare", "diagnose", "add",        "drop",
    "plan",  "runs",   "diff", "compile", "inspect",  "predict",    "correct",
    "bench", "deploy", "dbc",  "plot",    "report",   "modbus-map", "explain"};
constexpr std::array<std::string_view, 5> kReading{"runs", "diff", "inspect", "explain", "bench"};

/// Verbs whose words name files, which are looked for where the command runs.
constexpr std::array<std::string_view, 5> kOfFiles{"import", "inspect", "predict", "correct",
                                                   "bench"};

template <class List>
bool has(const List& list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

[[noreturn]] void refuse_job(std::string message, std::string help) {
  throw Failure(Exit::kUsage,
                {.code = "E-SERVE-JOB", .message = std::move(message), .help = std::move(help)});
}

/// "-o", "-oFILE" or a negative number; of longer options any.
bool is_allowed_option(const std::string& word) {
  if (word.size() < 2 || word[0] != '-' || word[1] == '-') return true;
  return word[1] == 'o' || word[1] == '.' || std::isdigit(static_cast<unsigned char>(word[1])) != 0;
}

void check_word(const std::string& word, const std::filesystem::path& folder) {
  if (word.size() > kLongestArg) refuse_job("a word of the command is too long", "4096 bytes");
  if (printable_text(word) != word)
    refuse_job("a word of the command holds a character that is no text", "leave it out");
  if (!is_allowed_option(word))
    refuse_job(fmt::format("the option {} cannot be given here", printable_line(word)),
               "the cell is that of the server");
  if (leads_outside(word, folder))
    refuse_job(fmt::format("'{}' leads out of the folder of the cell", printable_line(word)),
               "copy the file into the folder, or give the command in a shell");
}

bool names_files(const JobRequest& job) {
  return has(kOfFiles, job.verb) ||
         std::any_of(job.args.begin(), job.args.end(), [](const std::string& word) {
           return word.starts_with("-o") || word.starts_with("--output") || word == "--data";
         });
}

}  // namespace

void check_job(const JobRequest& job, const std::filesystem::path& folder) {
  if (!has(kVerbs, job.verb))
    refuse_job(fmt::format("'{}' is not a verb of the workbench", printable_line(job.verb)),
               "give the command in a shell; the page will show what changed");
  if (job.args.size() > kMostArgs) refuse_job("the command has too many words", "at most 64");
  for (const auto& word : job.args) check_word(word, folder);
}

ChildCommand job_process(const JobRequest& job, const std::filesystem::path& folder) {
  ChildCommand out{{own_program().string(), "-C", folder.string(), job.verb}, folder};
  out.words.insert(out.words.end(), job.args.begin(), job.args.end());
  if (!has(job.args, "--json")) out.words.emplace_back("--json");
  return out;
}

std::string job_command(const JobRequest& job, const std::filesystem::path& folder) {
  const std::string where = shell_word(folder.string());
  std::string out = names_files(job) ? fmt::format("cd {} && plumb {}", where, job.verb)
                                     : fmt::format("plumb -C {} {}", where, job.verb);
  for (const auto& word : job.args)
    if (word != "--json") out += ' ' + shell_word(word);
  return out;
}

bool only_reads(const JobRequest& job) { return has(kReading, job.verb); }

}  // namespace plumb::offline::workbench
