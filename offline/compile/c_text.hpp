// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

/// Pieces of C source text.
namespace plumb::offline {

/// An identifier that every C and C++ compiler takes, from the name of a file without its folders
/// and last suffix: "arm-4.h" gives arm_4. What begins with a digit, or has no usable character,
/// gets "model" in front. Never a reserved name.
std::string c_identifier(const std::string& file);

/// Text that can neither end a comment nor begin one, nor break its line or turn its direction. It
/// must not stand last in its line, where a backslash or ??/ would join the next one.
std::string c_comment_text(const std::string& text);

/// Shortest digits of a double that read back to the same bits. x is finite.
std::string c_number(double x);

/// static const double NAME[...] = {...}; a new line every `row` numbers, and where one is full.
std::string c_table(const std::string& name, const std::vector<double>& numbers, std::size_t row);

}  // namespace plumb::offline
