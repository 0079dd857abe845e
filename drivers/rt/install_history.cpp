// SPDX-License-Identifier: Apache-2.0
#include "rt/install_history.hpp"

#include <pwd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>

#include "rt/synced_files.hpp"
#include "rt/utc.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMostHistory = 16u << 20;

std::string word_in(const Json& json, const char* key) {
  const auto at = json.find(key);
  return at != json.end() && at->is_string() ? at->get<std::string>() : "";
}

/// A line without a version is none.
HistoryLine from_json(const Json& json) {
  HistoryLine out;
  if (!json.is_object()) return out;
  out.version = word_in(json, "version");
  if (!is_version_id(out.version)) return {};
  out.time = word_in(json, "time");
  out.what = word_in(json, "what");
  out.previous = word_in(json, "previous");
  out.by = word_in(json, "by");
  out.host = word_in(json, "host");
  out.key = word_in(json, "key");
  out.key_id = word_in(json, "key_id");
  out.made = word_in(json, "made");
  out.from = word_in(json, "from");
  out.how = word_in(json, "how");
  if (json.contains("model") && json["model"].is_number_integer())
    out.model = json["model"].get<std::int64_t>();
  return out;
}

std::vector<HistoryLine> read_lines(const fs::path& file, std::uint64_t& damaged) {
  std::vector<HistoryLine> out;
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return out;
  const std::uintmax_t size = fs::file_size(file, error);
  std::ifstream in(file, std::ios::binary);
  std::string line;
  if (!error && size > kMostHistory) {
    in.seekg(static_cast<std::streamoff>(size - kMostHistory));
    std::getline(in, line);  // the rest of a line
  }
  while (std::getline(in, line)) {
    if (line.empty()) continue;
    HistoryLine one = from_json(Json::parse(line, nullptr, false));
    const bool known = one.what == "install" || one.what == "rollback" || one.what == "refused";
    if (one.version.empty() || !known)
      ++damaged;
    else
      out.push_back(std::move(one));
  }
  return out;
}

/// The versions on the way to the last one. An install goes on from there; a rollback goes back to
/// a version of the way, and what came after it is no longer on it.
std::vector<std::string> path_of(const std::vector<HistoryLine>& lines) {
  std::vector<std::string> path;
  for (const HistoryLine& line : lines) {
    const auto at = std::find(path.begin(), path.end(), line.version);
    if (line.what == "rollback" && at != path.end()) {
      path.erase(at + 1, path.end());
      continue;
    }
    if (at != path.end()) path.erase(at);
    if (path.empty() && !line.previous.empty()) path.push_back(line.previous);
    path.push_back(line.version);
  }
  return path;
}

}  // namespace

Json to_json(const HistoryLine& line) {
  return {{"time", line.time},         {"what", line.what},     {"version", line.version},
          {"previous", line.previous}, {"by", line.by},         {"host", line.host},
          {"key", line.key},           {"key_id", line.key_id}, {"made", line.made},
          {"from", line.from},         {"how", line.how},       {"model", line.model}};
}

const HistoryLine* History::last_of(const std::string& version) const {
  for (auto at = lines.rbegin(); at != lines.rend(); ++at)
    if (at->version == version) return &*at;
  return nullptr;
}

History read_history(const InstallPlace& place, const std::string& current) {
  History out;
  for (HistoryLine& line : read_lines(place.history(), out.damaged)) {
    if (line.what != "refused")
      out.lines.push_back(std::move(line));
    else if (!out.lines.empty() && out.lines.back().version == line.version)
      out.lines.pop_back();
  }
  if (!out.lines.empty() && out.lines.back().version != current) {
    out.cut_off = out.lines.back().version;
    out.lines.pop_back();
  }
  out.path = path_of(out.lines);
  if (!current.empty() && (out.path.empty() || out.path.back() != current))
    out.path.push_back(current);  // a history that was lost
  for (const HistoryLine& line : out.lines)
    if (line.what == "install") out.newest_made = std::max(out.newest_made, line.made);
  return out;
}

void append_history(const InstallPlace& place, const HistoryLine& line) {
  append_synced(place.history(),
                to_json(line).dump(-1, ' ', false, Json::error_handler_t::replace));
  sync_folder(place.folder);
}

std::string user_name(unsigned uid) {
  const passwd* const entry = ::getpwuid(static_cast<uid_t>(uid));
  return entry == nullptr ? std::to_string(uid) : entry->pw_name;
}

HistoryLine history_line(std::string what, std::string version, std::string previous) {
  HistoryLine out;
  out.time = utc_text(utc_ns() / 1'000'000);
  out.what = std::move(what);
  out.version = std::move(version);
  out.previous = std::move(previous);
  out.by = user_name(::getuid());
  const char* const caller = std::getenv("SUDO_USER");
  if (::getuid() == 0 && caller != nullptr && *caller != '\0')
    out.by += std::string(" (sudo by ") + caller + ")";
  std::array<char, 256> host{};
  if (::gethostname(host.data(), host.size() - 1) == 0) out.host = host.data();
  return out;
}

}  // namespace plumb::drivers::rt
