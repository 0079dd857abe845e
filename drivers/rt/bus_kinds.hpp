// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "program/toml_table.hpp"
#include "rt/bus_source.hpp"

namespace plumb::drivers::rt {

/// One kind of bus. A new kind is added by one entry in bus_kinds().
struct BusKind {
  const char* word;  // the value of `kind` in [source], for example "can"

  /// Reads the keys of [source] besides `kind`; paths of files are relative to `folder`.
  /// Problems are reported to the table's source.
  std::shared_ptr<const BusSource> (*read)(TomlTable& source, const std::filesystem::path& folder);
};

/// All kinds, in the order in which messages list them.
std::span<const BusKind> bus_kinds();

}  // namespace plumb::drivers::rt
