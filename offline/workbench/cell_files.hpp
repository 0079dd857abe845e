// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "workbench/response.hpp"
#include "workbench/services.hpp"

/// The files that lie directly in the folder of a cell. Names are plain ones (names.hpp). Symbolic
/// links that lead elsewhere do not count as files.
namespace plumb::offline::workbench {

/// [{name, bytes, changed}], as JSON, those that may be read.
std::string list_files(const std::filesystem::path& folder);

/// A file with its type. Throws Failure (E-SERVE-MISSING) if it is none that may be read.
Response read_cell_file(const std::filesystem::path& folder, const std::string& name);

/// Stores a measurement file or another text, whole or not at all. Returns {name, bytes}. Throws
/// Failure (E-EXISTS, E-SERVE-REQUEST, E-WRITE).
std::string store_file(const std::filesystem::path& folder, const std::string& name,
                       const std::string& content, Services::Replace replace);

}  // namespace plumb::offline::workbench
