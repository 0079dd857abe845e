// SPDX-License-Identifier: Apache-2.0
#include "workbench/cell_files.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

#include "cell/iso_time.hpp"
#include "program/bounded_file.hpp"
#include "program/file.hpp"
#include "workbench/names.hpp"

namespace plumb::offline::workbench {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t kMostRead = std::uintmax_t{16} << 20;
constexpr std::size_t kMostListed = 1000;

struct Kind {
  std::string_view ending;
  const char* type;
  Response::Content content = Response::Content::kData;
};
constexpr std::array<Kind, 9> kKinds{
    {{".csv", "text/plain; charset=utf-8"},
     {".txt", "text/plain; charset=utf-8"},
     {".toml", "text/plain; charset=utf-8"},
     {".dbc", "text/plain; charset=utf-8"},
     {".md", "text/plain; charset=utf-8"},
     {".json", "application/json"},
     {".plumb", "application/octet-stream"},
     {".svg", "image/svg+xml", Response::Content::kPicture},
     {".html", "text/html; charset=utf-8", Response::Content::kReport}}};
constexpr std::array<std::string_view, 3> kStored{".csv", ".txt", ".toml"};

const Kind* kind_of(const std::string& name) {
  const auto found = std::find_if(kKinds.begin(), kKinds.end(),
                                  [&](const Kind& kind) { return name.ends_with(kind.ending); });
  return found == kKinds.end() ? nullptr : &*found;
}

/// What lies there, if it is a file of the folder itself.
std::optional<struct stat> regular_file(const fs::path& folder, const std::string& name) {
  struct stat found {};
  const fs::path file = folder / name;
  if (::stat(file.c_str(), &found) != 0 || !S_ISREG(found.st_mode)) return std::nullopt;
  if (!lies_inside(file, folder)) return std::nullopt;
  return found;
}

}  // namespace

std::string list_files(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    std::string name = at->path().filename().string();
    if (is_plain_name(name) && kind_of(name) != nullptr) names.push_back(std::move(name));
    if (names.size() == kMostListed) break;
  }
  std::sort(names.begin(), names.end());
  Json out = Json::array();
  for (const auto& name : names)
    if (const auto found = regular_file(folder, name))
      out.push_back(
          {{"name", name}, {"bytes", found->st_size}, {"changed", iso_utc(found->st_mtim.tv_sec)}});
  return json_line(out);
}

Response read_cell_file(const fs::path& folder, const std::string& name) {
  const Kind* const kind = kind_of(name);
  if (kind == nullptr || !regular_file(folder, name))
    throw Failure(Exit::kUsage, {.code = "E-SERVE-MISSING",
                                 .message = fmt::format("the folder of the cell has no {}", name),
                                 .help = "GET /api/files lists what can be read"});
  return {.type = kind->type,
          .body = bytes(read_file_up_to(folder / name, kMostRead)),
          .content = kind->content};
}

std::string store_file(const fs::path& folder, const std::string& name, const std::string& content,
                       Services::Replace replace) {
  const bool known = std::any_of(kStored.begin(), kStored.end(),
                                 [&](std::string_view end) { return name.ends_with(end); });
  if (!known || name == "cell.toml")
    throw Failure(Exit::kUsage, {.code = "E-SERVE-REQUEST",
                                 .message = "only csv, txt and toml files can be stored here",
                                 .help = "cell.toml itself is changed by PUT /api/cell"});
  const fs::path file = folder / name;
  std::error_code error;
  if (fs::exists(fs::symlink_status(file, error)) && !regular_file(folder, name))
    throw Failure(Exit::kUsage, {.code = "E-SERVE-REQUEST",
                                 .message = fmt::format("{} is not a file of this folder", name),
                                 .help = "choose another name"});
  if (replace == Services::Replace::kNo && would_replace(file))
    throw Failure(Exit::kUsage, {.code = "E-EXISTS",
                                 .message = fmt::format("{} is already there", name),
                                 .help = "choose another name, or replace it with ?force=1"});
  write_file_atomically(file, content);
  return Json{{"name", name}, {"bytes", content.size()}}.dump();
}

}  // namespace plumb::offline::workbench
