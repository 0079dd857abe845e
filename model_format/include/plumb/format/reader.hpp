// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <variant>

#include "plumb/format/model.hpp"
#include "plumb/format/read_error.hpp"

namespace plumb::format {

/// Reads and checks a model: length, identifier, checksum, schema version, flatbuffers verifier,
/// then the semantic check (finite numbers, ranges, acyclic trees, depths, indices). It never
/// throws on bad content, never reads outside `bytes` and never returns an invalid model. Heap:
/// yes. Cost: grows with the size of the file, milliseconds. Any thread, outside the cycle.
std::variant<Model, ReadError> read_model(std::span<const std::byte> bytes);
std::variant<Model, ReadError> read_model(const std::filesystem::path& file);

}  // namespace plumb::format
