// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "answers/action.hpp"
#include "program/outcome.hpp"
#include "show/json.hpp"
#include "show/table.hpp"

/// A result as a sequence of blocks, made once and rendered by three media: text_of for a terminal,
/// report::Html::blocks for a page, to_json for programs and the workbench.
namespace plumb::offline::show {

/// What was found.
struct Sentence {
  std::string words;
  std::string found = {};  // good, partly, bad or unknown: the colour; empty: it does not judge
};

/// What one should know beside it.
struct Note {
  std::string words;  // of several sentences each may stand on a line
  enum class Stands { kAlone, kUnder, kBelow } stands = Stands::kAlone;  // kUnder: indented
};

inline Note under(std::string words) { return {std::move(words), Note::Stands::kUnder}; }

/// A figure of `plumb plot`; a terminal leaves it out.
struct Figure {
  std::string name;
};

/// A terminal leaves an action out, for only the verb knows its folder: see cli/next_line.hpp.
using Block = std::variant<Sentence, Table, Figure, Note, Action>;
using Blocks = std::vector<Block>;

void append(Blocks& out, Blocks more);

/// For a terminal: an empty line before every block, but none between sentences, before a note that
/// stands under or below, and before a table that goes on.
std::string text_of(const Blocks& blocks);

/// [{kind: "sentence", words, class}, {kind: "table", name, caption, head, rows}, {kind: "figure",
/// name}, {kind: "note", words}, {kind: "action", command, why}]
Json to_json(const Blocks& blocks);

/// Makes them the text of a verb and `blocks` of its result.
void put(const Blocks& blocks, Outcome& outcome);

}  // namespace plumb::offline::show
