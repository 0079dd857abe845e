// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "program/verdict.hpp"

namespace plumb {

/// The properties of the terminal or file behind stdout or stderr.
struct Screen {
  std::size_t columns = 100;
  enum class Ink { kPlain, kColour } ink = Ink::kPlain;
  bool is_terminal = false;
};

/// COLUMNS if it is set, else the width of the terminal, else 100 columns. Colour on a terminal
/// only, and never with NO_COLOR (https://no-color.org) or TERM=dumb.
Screen screen_of(int descriptor);

/// The text with its sentences wrapped at the width of the screen, and a verdict at the beginning
/// of a line, up to its colon, in the colour of its class. In a table row (at least two blanks
/// between cells) the last cell is wrapped within its column. A table whose other cells are
/// too wide is split into several, one below the other, each with the first column. Commands to
/// paste are not wrapped; if one is too wide, the comment after it is moved to a line of its own.
/// From the first lines "--- FILE" and "+++ FILE" on, which begin a unified diff, the text stays as
/// it is.
std::string laid_out(const std::string& text, const Screen& screen,
                     std::span<const Verdict> verdicts = {});

/// The same for the text of --help: an example that is too wide is continued on the next line after
/// a backslash, so that it can still be pasted.
std::string laid_out_help(const std::string& help, const Screen& screen);

/// A message from `render` with its first word in its colour. For a terminal its sentence is
/// wrapped at the width of the screen; place and help, which can be pasted, are not. For a file or
/// a pipe the sentence stays on one line, so that it can be searched for.
std::string painted(const std::string& message, const Screen& screen);

}  // namespace plumb
