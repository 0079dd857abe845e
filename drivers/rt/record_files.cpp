// SPDX-License-Identifier: Apache-2.0
#include "rt/record_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>

#include "program/file.hpp"
#include "program/problem.hpp"
#include "rt/record_disk.hpp"
#include "rt/record_line.hpp"

namespace plumb::drivers::rt {
namespace {

/// True if the file begins as a record does. No line of a record is nearly as long.
bool begins_as_record(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string head(300, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  const std::size_t end = head.find('\n');
  return end != std::string::npos && parse_line(head.substr(0, end)).has_value();
}

/// Name and number, by which the files of a folder are ordered.
std::pair<std::string, std::uint64_t> order_of(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  const std::size_t dot = name.rfind('.');
  std::uint64_t number = 0;
  if (dot == std::string::npos) return {name, 0};
  const char* const end = name.data() + name.size();
  const auto read = std::from_chars(name.data() + dot + 1, end, number);
  const bool numbered = read.ec == std::errc() && read.ptr == end;
  return numbered ? std::pair(name.substr(0, dot), number) : std::pair(name, std::uint64_t{0});
}

std::vector<std::filesystem::path> records_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> out;
  std::error_code ended;
  for (std::filesystem::directory_iterator at(folder, ended), end; !ended && at != end;
       at.increment(ended)) {
    std::error_code ignored;
    if (at->is_regular_file(ignored) && begins_as_record(at->path())) out.push_back(at->path());
  }
  std::sort(out.begin(), out.end(),
            [](const auto& a, const auto& b) { return order_of(a) < order_of(b); });
  return out;
}

std::vector<std::filesystem::path> files_of_folder(const std::filesystem::path& folder,
                                                   const std::filesystem::path& record) {
  std::error_code ignored;
  if (!std::filesystem::exists(folder / "rt.toml", ignored)) return records_in(folder);
  std::vector<std::filesystem::path> out;
  if (!record.empty())
    for (const RecordPart& part : record_parts(record)) out.push_back(part.file);
  return out;
}

}  // namespace

std::vector<std::filesystem::path> record_files(const std::vector<std::string>& given,
                                                const std::filesystem::path& record) {
  std::vector<std::filesystem::path> out;
  for (const std::string& one : given) {
    std::error_code ignored;
    if (!std::filesystem::is_directory(one, ignored)) {
      if (!std::filesystem::is_regular_file(one, ignored))
        std::ignore = read_file(one);  // says in its own words what is wrong
      out.emplace_back(one);
      continue;
    }
    const auto found = files_of_folder(one, record);
    if (found.empty())
      throw Failure(Exit::kInput,
                    {.code = "E-RT-REPLAY",
                     .message = fmt::format("there is no record in {}", display_name(one)),
                     .help = "name its files: plumb-rt replay record.log record.log.1 --dir DIR"});
    out.insert(out.end(), found.begin(), found.end());
  }
  return out;
}

}  // namespace plumb::drivers::rt
