// SPDX-License-Identifier: Apache-2.0
#include "rt/machine_files.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace plumb::drivers::rt {

std::optional<std::string> MachineFiles::read(const std::string& file) const {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path_of(file), ignored)) return std::nullopt;
  std::ifstream in(path_of(file));
  std::ostringstream text;
  text << in.rdbuf();
  if (!in || in.bad()) return std::nullopt;
  std::string out = text.str();
  out.erase(out.find_last_not_of(" \t\n") + 1);
  return out;
}

std::optional<std::string> MachineFiles::line(const std::string& file,
                                              const std::string& key) const {
  std::istringstream in(read(file).value_or(""));
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(key)) continue;
    const auto begin = line.find_first_not_of(" \t:", key.size());
    return begin == std::string::npos ? "" : line.substr(begin);
  }
  return std::nullopt;
}

std::vector<std::string> MachineFiles::names(const std::string& folder) const {
  std::vector<std::string> out;
  std::error_code error;
  for (std::filesystem::directory_iterator it(path_of(folder), error), end; !error && it != end;
       it.increment(error))
    out.push_back(it->path().filename().string());
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace plumb::drivers::rt
