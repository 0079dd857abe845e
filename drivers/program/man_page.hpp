// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "program/command_table.hpp"
#include "program/exit_codes.hpp"

namespace plumb {

/// The parts of a manual page that do not follow from the options.
struct ManualText {
  std::string version = {};
  std::vector<FileRow> files = {};
  ExitRow::Of exits = ExitRow::Of::kEveryProgram;
  std::vector<std::string> see_also = {};  // other programs
};

/// The manual page, section 1, in the man macros of roff. It holds no date, so that a build can be
/// repeated to the byte.
std::string man_page(const CommandTable& table, const ManualText& text);

}  // namespace plumb
