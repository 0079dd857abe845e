// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace plumb {

/// Value of a scalar without its derivatives. Numbers with derivatives bring their own.
inline double plain(double x) noexcept { return x; }

}  // namespace plumb
