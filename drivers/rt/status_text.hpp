// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "plumb/drivers/run_shared.hpp"
#include "program/json.hpp"
#include "rt/ceilings.hpp"
#include "rt/recorder.hpp"
#include "rt/run_origin.hpp"

namespace plumb::drivers::rt {

/// The state of a run that is not in the cycle's snapshot.
struct RunFacts {
  std::string bus;  // "can0"
  std::string model_file;
  std::string model_sha256;
  std::string model_name;  // of the robot in the model, else of the file
  format::GuardLimits model_limits = {};
  Ceilings ceilings = {};
  RecordFacts record;
  std::string cause;           // of the present state, as cause_text() says
  std::string acknowledge;     // why an operator must acknowledge first; empty: that is not needed
  std::string packing;         // of the controller's registers, and its remedy; empty: as laid out
  std::string shortage;        // of file descriptors; empty: there is none
  std::string events;          // file of the journal; empty: none
  std::string events_failure;  // empty: none
  std::uint64_t events_lost = 0;
  RunOrigin origin;
};

/// Why a session came to the state that it has at this moment, in a few words: "pose-mismatch",
/// "target, joints", "mode shadow", "told to stop"; in INIT and SHADOW what it waits for; empty in
/// ACTIVE.
std::string cause_text(const SessionMoment& moment);

/// {state, mode, cause, fault, status, lost[], has_output, correction{}, ages{}, sync{},
/// counters{}, link{}, clock{}, latency_us{}, model{}, install{}, record{}}; times in the unit of
/// the key.
Json status_json(const RunSnapshot& snapshot, const RunFacts& facts);

/// The status for people; `status` is the result of status_json.
std::string status_text(const Json& status);

/// Prometheus text exposition format 0.0.4.
std::string metrics_text(const RunSnapshot& snapshot, const RunFacts& facts);

}  // namespace plumb::drivers::rt
