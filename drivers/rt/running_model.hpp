// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "plumb/runtime/loaded_model.hpp"
#include "rt/folder_origin.hpp"

namespace plumb::drivers::rt {

/// A model that may run; its number is the fingerprint of its file.
struct RunningModel {
  std::unique_ptr<const LoadedModel> loaded;
  std::string sha256;
  Origin origin = {};   // of the folder that it came in, if that was looked at
  std::string version;  // of the place that it came in; empty: none
};

/// The most that is read of a model file; the largest that the format can hold is smaller.
inline constexpr std::uintmax_t kMostModelBytes = 16u << 20;

/// Reads and verifies a model file, which must be a regular one. Throws Failure (kInput):
/// E-RT-MODEL, or E-RT-SERIAL if `serial` is not empty and not the model's. Slow.
RunningModel load_model(const std::filesystem::path& file, const std::string& serial);

}  // namespace plumb::drivers::rt
