// SPDX-License-Identifier: Apache-2.0
#include "rt/check_sums.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "program/bounded_file.hpp"
#include "program/file.hpp"
#include "program/problem.hpp"
#include "program/shell_word.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSums = "SHA256SUMS";
constexpr const char* kConfigurationFile = "rt.toml";
constexpr std::size_t kDigits = 64;
constexpr std::uintmax_t kMostBytes = 256u << 20;  // of a file that is summed

[[noreturn]] void refuse_sums(const std::string& what, const std::string& help) {
  throw Failure(Exit::kInput, {.code = "E-RT-SUMS", .message = what, .help = help});
}

std::string seal_command(const fs::path& folder, const char* option = "") {
  return fmt::format("plumb-rt seal {}{}", shell_word(display_name(folder)), option);
}

[[noreturn]] void refuse_list(const fs::path& folder, const std::string& why) {
  refuse_sums(fmt::format("{} {}", display_name(folder / kSums), why),
              "plumb deploy writes it; to accept the files that are there: " +
                  seal_command(folder, " --all"));
}

SummedFile read_line(const fs::path& folder, const std::string& line) {
  const std::size_t begin = line.find_first_not_of(" *", std::min(kDigits, line.size()));
  const bool digits = line.find_first_not_of("0123456789abcdef") == kDigits;
  if (!digits || begin == std::string::npos)
    refuse_list(folder, fmt::format("has a line that is no check sum: '{}'", line.substr(0, 80)));
  SummedFile out{.name = line.substr(begin), .sha256 = line.substr(0, kDigits)};
  std::error_code error;
  if (!fs::is_regular_file(folder / out.name, error))
    out.state = SummedFile::State::kMissing;
  else if (sha256(read_regular_file(folder / out.name, kMostBytes)) != out.sha256)
    out.state = SummedFile::State::kOther;
  return out;
}

/// The name of a file in SHA256SUMS: relative to the folder.
std::string listed_name(const fs::path& folder, const fs::path& file) {
  return fs::absolute(file)
      .lexically_normal()
      .lexically_proximate(fs::absolute(folder / "").lexically_normal())
      .string();
}

bool lists(const std::vector<SummedFile>& files, const fs::path& folder, const std::string& name) {
  return std::any_of(files.begin(), files.end(), [&](const SummedFile& one) {
    return listed_name(folder, folder / one.name) == name;
  });
}

[[noreturn]] void refuse_file(const fs::path& folder, const SummedFile& file) {
  const std::string name = display_name(folder / file.name);
  if (file.state == SummedFile::State::kMissing)
    refuse_sums(fmt::format("{} is missing, and SHA256SUMS lists it", name),
                "deploy again, or accept what is there: " + seal_command(folder, " --all"));
  refuse_sums(
      fmt::format("{} is not the file that SHA256SUMS lists", name),
      file.name == kConfigurationFile
          ? "if you edited it: " + seal_command(folder)
          : "deploy again, or, if it was replaced on purpose: " + seal_command(folder, " --all"));
}

std::vector<SummedFile> read_sums_if_any(const fs::path& folder) {
  try {
    return read_sums(folder);
  } catch (const Failure&) {
    return {};
  }
}

}  // namespace

std::vector<SummedFile> read_sums(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder / kSums, error)) refuse_list(folder, "is missing");
  std::vector<SummedFile> out;
  std::istringstream lines(read_regular_file(folder / kSums, kMostBytes));
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) out.push_back(read_line(folder, line));
  if (out.empty()) refuse_list(folder, "is empty");
  return out;
}

void verify_sums(const fs::path& folder, const fs::path& model) {
  const auto files = read_sums(folder);
  for (const std::string& name : {std::string(kConfigurationFile), listed_name(folder, model)})
    if (!lists(files, folder, name)) refuse_list(folder, fmt::format("does not list {}", name));
  for (const SummedFile& file : files)
    if (file.state != SummedFile::State::kAsListed) refuse_file(folder, file);
}

std::vector<SummedFile> renew_sums(const fs::path& folder, const fs::path& model, Renew renew) {
  const auto before = renew == Renew::kAll ? read_sums_if_any(folder) : read_sums(folder);
  const std::string own = listed_name(folder, model);
  std::vector<std::string> names{kConfigurationFile, own};
  if (renew == Renew::kConfiguration && !lists(before, folder, own))
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
  write_file_atomically(folder / kSums, text);
  return before;
}

}  // namespace plumb::drivers::rt
