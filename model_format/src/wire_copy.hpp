// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>

#include "plumb/format/model.hpp"
#include "plumb/format/read_error.hpp"

namespace plumb::format::wire {
struct Model;
}

namespace plumb::format::internal {

/// Copies a verified flatbuffer into plain structs; absent fields keep their defaults.
///
/// The verifier only proves that every offset stays inside the buffer. Strings may still share
/// their bytes, so that the copies of a small file would need terabytes, and the numbers of a
/// vector may be misaligned. Both are refused (kMalformed), as are more trees than axes
/// (kInconsistent). Needs at most kMaxFileBytes of memory for strings and numbers. The meaning of
/// the content is not checked here.
std::variant<Model, ReadError> copy_model(const wire::Model& model);

}  // namespace plumb::format::internal
