// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <variant>

#include "plumb/format/model.hpp"

namespace plumb::format {

enum class ReadErrorCode : std::uint8_t {
  kCannotOpen,    // missing, a directory, no permission
  kTooLarge,      // more than kMaxFileBytes
  kTruncated,     // empty, or the file does not end with its own length
  kNotAModel,     // another kind of file
  kChecksum,      // the checksum is wrong: the file is damaged
  kNewerSchema,   // written by a newer version of Plumb
  kMalformed,     // the flatbuffers verifier rejects it
  kInconsistent,  // it passes the verifier, but its content is contradictory or out of range
};

struct ReadError {
  ReadErrorCode code = ReadErrorCode::kMalformed;
  std::string detail;  // one sentence that names the fault, its place and the value
};

/// Reads and checks a model: length, identifier, checksum, schema version, flatbuffers verifier,
/// then the semantic check (finite numbers, ranges, acyclic trees, depths, indices). It never
/// throws on bad content, never reads outside `bytes` and never returns an invalid model. Slow, and
/// allocates: to be called outside the cycle.
std::variant<Model, ReadError> read_model(std::span<const std::byte> bytes);
std::variant<Model, ReadError> read_model(const std::filesystem::path& file);

}  // namespace plumb::format
