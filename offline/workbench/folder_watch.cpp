// SPDX-License-Identifier: Apache-2.0
#include "workbench/folder_watch.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <system_error>

namespace plumb::offline::workbench {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMostEntries = 1000;

std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> out;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    out.push_back(at->path());
    if (out.size() == kMostEntries) break;
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace

std::string stamp_of(const fs::path& file) {
  struct stat found {};
  if (::stat(file.c_str(), &found) != 0) return "-";
  return fmt::format("{}:{}:{}.{}", found.st_ino, found.st_size, found.st_mtim.tv_sec,
                     found.st_mtim.tv_nsec);
}

std::string stamps_of(const std::vector<fs::path>& files) {
  std::string out;
  for (const auto& file : files) out += file.string() + '=' + stamp_of(file) + '\n';
  return out;
}

std::string stamps_of_runs(const fs::path& folder) {
  std::string out;
  for (const auto& run : entries_of(folder / "runs"))
    out += stamps_of({run / "run.json", run / "predictions.csv", run / "noise_floor.json",
                      run / "diagnosis.json"});
  return out;
}

std::string stamps_inside(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : entries_of(folder)) {
    struct stat found {};
    if (::stat(entry.c_str(), &found) == 0 && S_ISREG(found.st_mode)) files.push_back(entry);
  }
  return stamps_of(files);
}

}  // namespace plumb::offline::workbench
