// SPDX-License-Identifier: Apache-2.0
#include "rt/listed_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "program/file.hpp"
#include "program/problem.hpp"
#include "program/shell_word.hpp"
#include "program/sums_signature.hpp"

namespace plumb::drivers::rt {
namespace {

constexpr std::size_t kSumDigits = 64;

/// True for a name that leads to a file below the folder, however the folder is named.
bool stays_inside(const std::string& name) {
  const std::filesystem::path path = name;
  if (name.empty() || path.is_absolute() || name.find('\0') != std::string::npos) return false;
  return path.lexically_normal() == path &&
         std::none_of(path.begin(), path.end(),
                      [](const auto& part) { return part == ".." || part == "." || part.empty(); });
}

}  // namespace

std::vector<std::string> listed_files(const std::filesystem::path& folder,
                                      const std::string& sums) {
  const auto refuse = [&](const char* code, const std::string& what) {
    throw Failure(Exit::kInput,
                  {.code = code,
                   .message = fmt::format("{} {}", display_name(folder / kSumsFile), what),
                   .help = "deploy again: plumb deploy -o " + shell_word(display_name(folder))});
  };
  std::vector<std::string> out;
  std::istringstream lines(sums);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty()) continue;
    const bool sum = line.find_first_not_of("0123456789abcdef") == kSumDigits;
    const std::size_t begin = line.find_first_not_of(" *", std::min(kSumDigits, line.size()));
    if (!sum || begin == std::string::npos)
      refuse("E-RT-SUMS", fmt::format("has a line that is no check sum: '{}'", line.substr(0, 80)));
    const std::string name = line.substr(begin);
    if (!stays_inside(name))
      refuse("E-RT-FOLDER", fmt::format("lists '{}', which is no file of the folder", name));
    if (name == kSumsFile || name == kSignatureFile)
      refuse("E-RT-FOLDER", fmt::format("lists {}, which it cannot know", name));
    out.push_back(name);
  }
  return out;
}

}  // namespace plumb::drivers::rt
