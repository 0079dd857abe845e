// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace plumb {

/// 0: ok. > 0: valid, but degraded. < 0: refused, and the correction decays to zero.
enum class [[nodiscard]] Status : std::int8_t{
    kOk = 0,
    kOutsideDomain = 1,    // outside the trained joint domain: the tree has faded, physics only
    kContextFallback = 2,  // an effect's input was missing or stale: its declared fallback was used
    kLimited = 3,          // the guard cut the correction to its size or slew limit
    kRamping = 4,          // the correction is still being ramped in

    kNotFinite = -1,           // a target, joint position or context is NaN or infinite
    kNearSingular = -2,        // the smallest singular value is under its limit
    kOtherConfiguration = -3,  // the solution lies in another configuration than the seed
    kFarFromSeed = -4,         // the solution is farther from the seed than allowed
    kNotConverged = -5,        // the residual exceeds 1 um or 1 urad
    kSeedNotCommanded = -6,    // more than six joints need the commanded joints as seed
    kNoModel = -7,
    kStale = -8,  // no fresh target or joint state for too long
};

constexpr bool refused(Status s) noexcept { return static_cast<std::int8_t>(s) < 0; }

/// Stable lower-case text for CSV and JSON, for example "near-singular".
const char* to_string(Status s) noexcept;

}  // namespace plumb
