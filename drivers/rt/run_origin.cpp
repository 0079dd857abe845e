// SPDX-License-Identifier: Apache-2.0
#include "rt/run_origin.hpp"

#include <fmt/format.h>

#include "rt/install_history.hpp"

namespace plumb::drivers::rt {

RunOrigin find_run_origin(const Deployment& deployment) {
  RunOrigin out;
  out.made = deployment.config.made;
  out.version = deployment.model.version;
  out.key = deployment.model.origin.key;
  out.key_id = deployment.model.origin.key_id;
  out.note = deployment.model.origin.note;
  if (!is_place(deployment.folder)) return out;
  const InstallPlace place{deployment.folder};
  out.place = std::filesystem::absolute(place.folder).lexically_normal().string();
  out.current = current_version_if_any(place);
  // An install writes its line before it asks for a swap, and changes `current` after it.
  const std::string version = out.version.empty() ? out.current : out.version;
  const History history = read_history(place, version);
  const HistoryLine* const line = history.last_of(out.version);
  if (line == nullptr) return out;
  out.made = line->made;
  out.installed_at = line->time;
  out.installed_by = line->host.empty() ? line->by : fmt::format("{} on {}", line->by, line->host);
  return out;
}

Json to_json(const RunOrigin& origin) {
  return {{"place", origin.place},
          {"version", origin.version},
          {"current", origin.current},
          {"restart_needed", origin.restart_needed()},
          {"made", origin.made},
          {"installed_at", origin.installed_at},
          {"installed_by", origin.installed_by},
          {"signed_by", origin.key},
          {"key_id", origin.key_id},
          {"note", origin.note}};
}

std::string run_origin_text(const Json& origin) {
  const auto word = [&](const char* key) { return origin.value(key, ""); };
  const std::string signer = !word("note").empty() ? word("note")
                             : word("signed_by").empty()
                                 ? ""
                                 : fmt::format("signed by {}", word("signed_by"));
  const std::string made = word("made").empty() ? "" : "made " + word("made");
  std::string line;
  if (!word("place").empty())
    line = fmt::format("version {}", word("version").empty() ? "none" : word("version"));
  if (!word("installed_by").empty())
    line += fmt::format(", installed {} by {}", word("installed_at"), word("installed_by"));
  for (const std::string& part : {made, signer})
    if (!part.empty()) line += (line.empty() ? "" : ", ") + part;
  std::string out = line.empty() ? "" : fmt::format("origin      {}\n", line);
  if (origin.value("restart_needed", false))
    out +=
        fmt::format("RESTART     version {} is installed but not running: start plumb-rt again\n",
                    word("current").empty() ? "none" : word("current"));
  return out;
}

Json event_details(const RunOrigin& origin) {
  Json out = Json::object();
  const Json all = to_json(origin);
  for (const auto& [key, value] : all.items())
    if (value.is_string() && !value.get<std::string>().empty() && key != "current")
      out[key] = value;
  return out;
}

}  // namespace plumb::drivers::rt
