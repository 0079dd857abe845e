// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace plumb::format {

/// Version of Plumb; CMake reads this line.
inline constexpr char kVersion[] = "0.1.0";

/// Version of the model file's schema. Files of every earlier version stay readable.
inline constexpr unsigned kSchemaVersion = 3;

}  // namespace plumb::format
