// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

namespace plumb::offline {

/// What `plumb explain CODE` says: why it happens and what to do, one paragraph.
struct CodeHelp {
  std::string_view code;
  std::string_view text;
};

/// Every code this folder emits, sorted.
std::span<const CodeHelp> cell_codes();

/// The explanation of a code, or null.
const CodeHelp* find_code(std::string_view code);

}  // namespace plumb::offline
