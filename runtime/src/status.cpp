// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/status.hpp"

namespace plumb {

const char* to_string(Status s) noexcept {
  switch (s) {
    case Status::kOk:
      return "ok";
    case Status::kOutsideDomain:
      return "outside-domain";
    case Status::kContextFallback:
      return "context-fallback";
    case Status::kLimited:
      return "limited";
    case Status::kRamping:
      return "ramping";
    case Status::kPartial:
      return "partial";
    case Status::kNotFinite:
      return "not-finite";
    case Status::kNearSingular:
      return "near-singular";
    case Status::kOtherConfiguration:
      return "other-configuration";
    case Status::kFarFromSeed:
      return "far-from-seed";
    case Status::kNotConverged:
      return "not-converged";
    case Status::kSeedNotCommanded:
      return "seed-not-commanded";
    case Status::kNoModel:
      return "no-model";
    case Status::kStale:
      return "stale";
  }
  return "unknown";
}

}  // namespace plumb
