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
  kTruncated,     // shorter than it says
  kNotAModel,     // another kind of file
  kChecksum,      // damaged
  kNewerSchema,   // written by a newer Plumb
  kMalformed,     // the flatbuffers verifier says no
  kInconsistent,  // verified, but the content makes no sense
};

struct ReadError {
  ReadErrorCode code = ReadErrorCode::kMalformed;
  std::string detail;  // one sentence: what, where, and which value
};

/// Reads and checks a model: length, identifier, checksum, schema version, flatbuffers verifier,
/// then the semantic check (finite, ranges, acyclic, depth, indices). Never throws on bad content,
/// never reads outside `bytes`, never returns a model that is not sound.
/// Slow (allocates); call it outside the cycle.
std::variant<Model, ReadError> read_model(std::span<const std::byte> bytes);
std::variant<Model, ReadError> read_model(const std::filesystem::path& file);

}  // namespace plumb::format
