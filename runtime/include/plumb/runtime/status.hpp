// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace plumb {

/// 0: ok. > 0: valid, but degraded. < 0: refused, and the correction decays to zero.
enum class [[nodiscard]] Status : std::int8_t{
    kOk = 0,
    kOutsideDomain = 1,    // a joint or context input is outside the range of the fit (KnownRange)
    kContextFallback = 2,  // an effect's input was missing or stale: its declared fallback was used
    kLimited = 3,          // the guard cut the correction to its size or slew limit
    kRamping = 4,          // the correction is being ramped in, or out because the guard is off
    kPartial = 5,          // near a singular pose; only a part of the position error is corrected

    kNotFinite = -1,           // the target is no pose, or a joint or predicted pose not finite
    kNearSingular = -2,        // the nominal Jacobian's smallest singular value is under its limit
    kOtherConfiguration = -3,  // the solution lies in another configuration than the seed
    kFarFromSeed = -4,         // the solution is farther from the seed than allowed
    kNotConverged = -5,        // before the last step more than 1 um or 1 urad was left
    kSeedNotCommanded = -6,    // more than six joints need the commanded joints as seed
    kNoModel = -7,             // nothing was computed; the default value
    kStale = -8,               // no fresh target or joint state for too long
};

constexpr bool refused(Status s) noexcept { return static_cast<std::int8_t>(s) < 0; }

/// Stable lower-case text for CSV and JSON, for example "near-singular".
const char* to_string(Status s) noexcept;

}  // namespace plumb
