// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "programs/program.hpp"

/// The languages of robot programs that are read: one file each, and one line in the table.
namespace plumb::offline::programs {

struct Language {
  std::string_view name;
  std::string_view endings;  // of file names, "|.mod|.prg|", lower case
  std::string_view data;     // ending of the file beside it that belongs to the program, or empty
  std::string_view comment;  // what stands before a comment line
  std::string_view end;      // and behind it
  std::size_t longest;       // characters of a comment
  // Fills all but the sources, and judges by what all programs say, this one included.
  void (*read)(Program&, const Facts& around);
  /// Where a comment line may be put: the offset of the beginning of a line. `bytes` is without a
  /// byte order mark.
  std::size_t (*comment_place)(std::string_view bytes);
};

/// The language that a file's name says; null if it is none of these.
const Language* language_of(const std::string& file);

/// ".mod, .prg, .ls, ...", for messages.
std::string known_endings();

/// Reads programs of one language, each of its sources, and settles which tool and frame each
/// target has. What one program does to the targets, tools and frames of another counts.
std::vector<Program> read_programs(const Language& language,
                                   std::vector<std::vector<Source>> programs);

void read_rapid(Program& program, const Facts& around);
void read_fanuc(Program& program, const Facts& around);
void read_krl(Program& program, const Facts& around);
void read_urscript(Program& program, const Facts& around);

std::size_t rapid_comment_place(std::string_view bytes);
std::size_t fanuc_comment_place(std::string_view bytes);
std::size_t krl_comment_place(std::string_view bytes);
std::size_t urscript_comment_place(std::string_view bytes);

}  // namespace plumb::offline::programs
