// SPDX-License-Identifier: Apache-2.0
#include "rt/check_sums.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "program/bounded_file.hpp"
#include "program/file.hpp"
#include "program/problem.hpp"
#include "program/shell_word.hpp"
#include "program/sums_signature.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;

constexpr const char* kConfigurationFile = "rt.toml";
constexpr std::size_t kDigits = 64;
constexpr std::uintmax_t kMostBytes = 256u << 20;  // of a file that is summed

[[noreturn]] void refuse_sums(const std::string& what, const std::string& help) {
  throw Failure(Exit::kInput, {.code = "E-RT-SUMS", .message = what, .help = help});
}

std::string seal_command(const fs::path& folder, const char* option = "") {
  return fmt::format("plumb-rt seal {}{}", shell_word(display_name(folder)), option);
}

/// What helps after a folder was changed: a signed one is not sealed, which would break it.
std::string after_change(const fs::path& folder, const std::string& unsigned_help) {
  std::error_code error;
  return fs::exists(folder / kSignatureFile, error)
             ? "the folder is signed: deploy it again with plumb deploy --sign FILE.key"
             : unsigned_help;
}

[[noreturn]] void refuse_list(const fs::path& folder, const std::string& why) {
  refuse_sums(fmt::format("{} {}", display_name(folder / kSumsFile), why),
              after_change(folder, "plumb deploy writes it; to accept the files that are there: " +
                                       seal_command(folder, " --all")));
}

SummedFile parse_sum(const fs::path& folder, const std::string& line) {
  const std::size_t begin = line.find_first_not_of(" *", std::min(kDigits, line.size()));
  const bool digits = line.find_first_not_of("0123456789abcdef") == kDigits;
  if (!digits || begin == std::string::npos)
    refuse_list(folder, fmt::format("has a line that is no check sum: '{}'", line.substr(0, 80)));
  return {.name = line.substr(begin), .sha256 = line.substr(0, kDigits)};
}

void compare(const fs::path& folder, SummedFile& out) {
  std::error_code error;
  if (!fs::is_regular_file(folder / out.name, error))
    out.state = SummedFile::State::kMissing;
  else if (sha256(read_regular_file(folder / out.name, kMostBytes)) != out.sha256)
    out.state = SummedFile::State::kOther;
}

/// The line of this file; null if there is none.
const SummedFile* line_of(const std::vector<SummedFile>& files, const fs::path& folder,
                          const std::string& name) {
  const auto at = std::find_if(files.begin(), files.end(), [&](const SummedFile& one) {
    return listed_name(folder, folder / one.name) == name;
  });
  return at == files.end() ? nullptr : &*at;
}

[[noreturn]] void refuse_file(const fs::path& folder, const SummedFile& file) {
  const std::string name = display_name(folder / file.name);
  if (file.state == SummedFile::State::kMissing)
    refuse_sums(fmt::format("{} is missing, and SHA256SUMS lists it", name),
                after_change(folder, "deploy again, or accept what is there: " +
                                         seal_command(folder, " --all")));
  refuse_sums(fmt::format("{} is not the file that SHA256SUMS lists", name),
              after_change(folder, file.name == kConfigurationFile
                                       ? "if you edited it: " + seal_command(folder)
                                       : "deploy again, or, if it was replaced on purpose: " +
                                             seal_command(folder, " --all")));
}

std::vector<SummedFile> read_sums_if_any(const fs::path& folder) {
  try {
    return read_sums(folder, sums_text(folder));
  } catch (const Failure&) {
    return {};
  }
}

}  // namespace

std::string listed_name(const fs::path& folder, const fs::path& file) {
  return fs::absolute(file)
      .lexically_normal()
      .lexically_proximate(fs::absolute(folder / "").lexically_normal())
      .string();
}

std::string sums_text(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder / kSumsFile, error)) refuse_list(folder, "is missing");
  return read_regular_file(folder / kSumsFile, kMostBytes);
}

std::vector<SummedFile> sum_lines(const fs::path& folder, const std::string& text) {
  std::vector<SummedFile> out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) out.push_back(parse_sum(folder, line));
  if (out.empty()) refuse_list(folder, "is empty");
  return out;
}

std::map<std::string, std::string> listed_sums(const fs::path& folder, const std::string& text) {
  std::map<std::string, std::string> out;
  for (SummedFile& file : sum_lines(folder, text)) out[file.name] = std::move(file.sha256);
  return out;
}

std::vector<SummedFile> read_sums(const fs::path& folder, const std::string& text) {
  std::vector<SummedFile> out = sum_lines(folder, text);
  for (SummedFile& file : out) compare(folder, file);
  return out;
}

void verify_sums(const fs::path& folder, const std::string& text,
                 const std::vector<fs::path>& files) {
  const auto listed = read_sums(folder, text);
  for (const fs::path& file : files) {
    const std::string name = listed_name(folder, file);
    if (line_of(listed, folder, name) == nullptr)
      refuse_list(folder, fmt::format("does not list {}", name));
  }
  for (const SummedFile& file : listed)
    if (file.state != SummedFile::State::kAsListed) refuse_file(folder, file);
}

void refuse_other(const fs::path& folder, const std::string& text, const fs::path& file,
                  const std::string& sha256) {
  const auto listed = sum_lines(folder, text);
  const std::string name = listed_name(folder, file);
  const SummedFile* const line = line_of(listed, folder, name);
  if (line == nullptr) refuse_list(folder, fmt::format("does not list {}", name));
  if (line->sha256 == sha256) return;
  refuse_file(folder, {.name = line->name, .sha256 = sha256, .state = SummedFile::State::kOther});
}

std::vector<SummedFile> renew_sums(const fs::path& folder, const fs::path& model, Renew renew) {
  auto before =
      renew == Renew::kAll ? read_sums_if_any(folder) : read_sums(folder, sums_text(folder));
  const std::string own = listed_name(folder, model);
  std::vector<std::string> names{kConfigurationFile, own};
  if (renew == Renew::kConfiguration && line_of(before, folder, own) == nullptr)
    refuse_list(folder, fmt::format("does not list {}", own));
  for (const SummedFile& file : before) {
    if (file.name == kConfigurationFile) continue;
    if (renew == Renew::kConfiguration && file.state != SummedFile::State::kAsListed)
      refuse_file(folder, file);
    if (file.state != SummedFile::State::kMissing && listed_name(folder, folder / file.name) != own)
      names.push_back(file.name);
  }
  std::string text;
  for (const std::string& name : names)
    text += fmt::format("{}  {}\n", sha256(read_regular_file(folder / name, kMostBytes)), name);
  write_file_atomically(folder / kSumsFile, text);
  return before;
}

}  // namespace plumb::drivers::rt
