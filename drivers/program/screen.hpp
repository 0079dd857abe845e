// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

namespace plumb {

/// What stdout or stderr can show.
struct Screen {
  std::size_t columns = 100;
  enum class Ink { kPlain, kColour } ink = Ink::kPlain;
  bool is_terminal = false;
};

/// COLUMNS if it is set, else the width of the terminal, else 100 columns. Colour on a terminal
/// only, and never with NO_COLOR (https://no-color.org) or TERM=dumb.
Screen screen_of(int descriptor);

/// Sentences broken at the width of the screen, and the judgement at the beginning of a line in its
/// colour. Of a table row (two blanks between cells) the words of the last cell are broken and stay
/// in their column; a table whose other cells are too wide is parted into several, one below the
/// other, each with the first column. Commands to paste stay whole; the comment behind one that is
/// too wide stands on a line of its own.
std::string laid_out(const std::string& text, const Screen& screen);

/// The same for the text of --help: an example that is too wide goes on in a further line behind a
/// backslash, so that it can still be pasted.
std::string laid_out_help(const std::string& help, const Screen& screen);

/// A message as `render` makes it, with its first word in its colour. A terminal gets its sentence
/// broken at its width; what holds the place and the help, which can be pasted, stays as it is. In
/// a file or a pipe a message stays one line, to be searched.
std::string painted(const std::string& message, const Screen& screen);

}  // namespace plumb
