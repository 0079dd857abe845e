// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ctime>
#include <optional>
#include <string>
#include <string_view>

namespace plumb::offline {

/// Seconds [s] from 1970 on of an ISO 8601 date and time, "2026-03-01T12:30:00.5+01:00"; a blank
/// may stand for the T, seconds and zone may be missing (UTC then). Nothing if it is none.
std::optional<double> iso_seconds(std::string_view text);

/// The other way: "2026-03-01T11:30:00Z".
std::string iso_utc(std::time_t seconds);

}  // namespace plumb::offline
