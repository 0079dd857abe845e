// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace plumb {

/// Value of a scalar without its derivatives. Types of numbers that carry derivatives overload it.
inline double plain(double x) noexcept { return x; }

}  // namespace plumb
