// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

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

}  // namespace plumb::format
