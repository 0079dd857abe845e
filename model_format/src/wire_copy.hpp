// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>

#include "plumb/format/model.hpp"
#include "plumb/format/reader.hpp"

namespace plumb::format::wire {
struct Model;
}

namespace plumb::format::internal {

/// Copies a verified flatbuffer into plain structs; what is absent keeps its default.
///
/// The verifier proves that every offset stays inside the buffer, and no more: strings may share
/// their bytes, so that a small file asks for terabytes, and the numbers of a vector may be
/// misaligned. Both are refused (kMalformed), as are more trees than axes (kInconsistent).
/// Needs at most kMaxFileBytes of memory for strings and numbers. The content is not judged.
std::variant<Model, ReadError> copy_model(const wire::Model& model);

}  // namespace plumb::format::internal
