// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace plumb::drivers::rt {

/// Why a plumb-rt that runs one deploy folder cannot go on with the other by a swap of the model:
/// the keys of rt.toml beside those of [model] that differ, such as "[limits] mode", and the files
/// that differ other than rt.toml, the model, and the DBC and Modbus map, which are for people.
/// Empty: a swap is enough. Throws Failure (kInput) if either cannot be read. Slow.
std::vector<std::string> restart_reasons(const std::filesystem::path& running,
                                         const std::filesystem::path& next);

}  // namespace plumb::drivers::rt
