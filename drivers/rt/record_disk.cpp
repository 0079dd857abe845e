// SPDX-License-Identifier: Apache-2.0
#include "rt/record_disk.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/statvfs.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <limits>
#include <optional>
#include <string>

namespace plumb::drivers::rt {
namespace {

std::int64_t system_clock_s() {
  const auto since = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::seconds>(since).count();
}

std::uint64_t system_free_bytes(const std::filesystem::path& folder) {
  struct statvfs found {};
  if (::statvfs(folder.c_str(), &found) != 0) return std::numeric_limits<std::uint64_t>::max();
  return static_cast<std::uint64_t>(found.f_bavail) * found.f_frsize;
}

/// The number of the part of the record `base` that has this name.
std::optional<std::uint64_t> number_in(const std::string& name, const std::string& base) {
  if (name == base) return 0;
  if (!name.starts_with(base + ".")) return std::nullopt;
  const char* const begin = name.data() + base.size() + 1;
  const char* const end = name.data() + name.size();
  std::uint64_t out = 0;
  const auto read = std::from_chars(begin, end, out);
  if (read.ec != std::errc() || read.ptr != end || *begin == '0') return std::nullopt;
  if (out == std::numeric_limits<std::uint64_t>::max()) return std::nullopt;  // none can follow it
  return out;
}

std::filesystem::path folder_of(const std::filesystem::path& file) {
  return std::filesystem::absolute(file).parent_path();
}

}  // namespace

RecordDisk real_disk() { return {.wall_s = system_clock_s, .free_bytes = system_free_bytes}; }

std::string why_not_written(const std::filesystem::path& file, int error, const std::string& what,
                            const RecordDisk& disk) {
  if (error != ENOSPC && error != EDQUOT)
    return fmt::format("{}: {}", file.string(), std::strerror(error));
  const std::uint64_t free = disk.free_bytes(folder_of(file));
  const bool known = free != std::numeric_limits<std::uint64_t>::max();
  return fmt::format(
      "{}: the {} is full{}: {} is no longer written, everything else goes on; make "
      "room on it",
      file.string(), error == EDQUOT ? "quota of the disk" : "disk",
      known ? fmt::format(", {:.1f} MB are free", 1e-6 * static_cast<double>(free)) : "", what);
}

std::vector<RecordPart> record_parts(const std::filesystem::path& file) {
  std::vector<RecordPart> out;
  std::error_code ended;
  const std::string base = file.filename().string();
  for (std::filesystem::directory_iterator at(folder_of(file), ended), end; !ended && at != end;
       at.increment(ended)) {
    const auto number = number_in(at->path().filename().string(), base);
    struct stat found {};
    if (!number || ::lstat(at->path().c_str(), &found) != 0 || !S_ISREG(found.st_mode)) continue;
    out.push_back({.file = file.parent_path() / at->path().filename(),
                   .number = *number,
                   .bytes = static_cast<std::uint64_t>(found.st_size),
                   .written_s = found.st_mtim.tv_sec});
  }
  std::sort(out.begin(), out.end(),
            [](const RecordPart& a, const RecordPart& b) { return a.number < b.number; });
  return out;
}

std::filesystem::path next_part(const std::filesystem::path& file) {
  const auto parts = record_parts(file);
  std::uint64_t number = parts.empty() ? 0 : parts.back().number + 1;
  const auto name = [&] {
    return number == 0 ? file : std::filesystem::path(fmt::format("{}.{}", file.string(), number));
  };
  std::error_code ignored;
  while (std::filesystem::exists(std::filesystem::symlink_status(name(), ignored))) ++number;
  return name();
}

}  // namespace plumb::drivers::rt
