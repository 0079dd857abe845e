// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "program/json.hpp"
#include "rt/deployment.hpp"

namespace plumb::drivers::rt {

/// Where what runs comes from, for status, journal and metrics.
struct RunOrigin {
  std::string place;         // that runs; empty: a deploy folder does
  std::string version;       // whose model runs; empty: of none
  std::string current;       // that the next start runs
  std::string made;          // by plumb deploy, UTC; empty: not known
  std::string installed_at;  // when the version last became current, UTC
  std::string installed_by;  // "anna on cell-pc"
  std::string key;           // trusted key that signed it; empty: none
  std::string key_id;        // of the key that its signature names; empty: it is unsigned
  std::string note;          // why it runs although no trusted key signed it

  /// True if the place was given another version that the next start will run.
  bool restart_needed() const { return !place.empty() && version != current; }
};

/// Reads the history of the place. Slow.
RunOrigin find_run_origin(const Deployment& deployment);

/// {place, version, current, restart_needed, made, installed_at, installed_by, signed_by, key_id,
/// note}
Json to_json(const RunOrigin& origin);

/// One or two lines of the status for people, from the object above.
std::string run_origin_text(const Json& origin);

/// What of it is not empty, for an event of the journal.
Json event_details(const RunOrigin& origin);

}  // namespace plumb::drivers::rt
