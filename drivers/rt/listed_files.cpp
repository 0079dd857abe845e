// SPDX-License-Identifier: Apache-2.0
#include "rt/listed_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "program/file.hpp"
#include "program/problem.hpp"
#include "program/shell_word.hpp"
#include "program/sums_signature.hpp"
#include "rt/check_sums.hpp"

namespace plumb::drivers::rt {
namespace {

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
  const auto refuse = [&](const std::string& what) {
    throw Failure(Exit::kInput,
                  {.code = "E-RT-FOLDER",
                   .message = fmt::format("{} lists {}", display_name(folder / kSumsFile), what),
                   .help = "deploy again: plumb deploy -o " + shell_word(display_name(folder))});
  };
  std::vector<std::string> out;
  for (SummedFile& file : sum_lines(folder, sums)) {
    if (!stays_inside(file.name))
      refuse(fmt::format("'{}', which is no file of the folder", file.name));
    if (file.name == kSumsFile || file.name == kSignatureFile)
      refuse(file.name + ", which it cannot know");
    out.push_back(std::move(file.name));
  }
  return out;
}

}  // namespace plumb::drivers::rt
