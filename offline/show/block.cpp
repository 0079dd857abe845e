// SPDX-License-Identifier: Apache-2.0
#include "show/block.hpp"

#include <utility>

namespace plumb::offline::show {
namespace {

struct TextOf {
  std::string operator()(const Sentence& s) const { return s.words + "\n"; }
  std::string operator()(const Table& t) const { return text_of(t); }
  std::string operator()(const Figure&) const { return ""; }
  std::string operator()(const Note& n) const {
    return (n.stands == Note::Stands::kUnder ? "  " : "") + n.words + "\n";
  }
  std::string operator()(const Action&) const { return ""; }
};

bool goes_on(const Block& before, const Block& next) {
  if (std::holds_alternative<Sentence>(next)) return std::holds_alternative<Sentence>(before);
  if (const Table* const table = std::get_if<Table>(&next)) return table->goes_on;
  const Note* const note = std::get_if<Note>(&next);
  return note != nullptr && note->stands != Note::Stands::kAlone;
}

struct JsonOf {
  Json operator()(const Sentence& s) const {
    return {{"kind", "sentence"}, {"words", s.words}, {"class", s.found}};
  }
  Json operator()(const Table& t) const {
    return {{"kind", "table"},
            {"name", t.name},
            {"caption", t.caption},
            {"head", t.head},
            {"rows", t.rows}};
  }
  Json operator()(const Figure& f) const { return {{"kind", "figure"}, {"name", f.name}}; }
  Json operator()(const Note& n) const { return {{"kind", "note"}, {"words", n.words}}; }
  Json operator()(const Action& a) const {
    return {{"kind", "action"}, {"command", a.typed()}, {"why", a.why}};
  }
};

}  // namespace

void append(Blocks& out, Blocks more) {
  for (Block& one : more) out.push_back(std::move(one));
}

std::string text_of(const Blocks& blocks) {
  std::string out;
  const Block* before = nullptr;
  for (const Block& block : blocks) {
    const std::string text = std::visit(TextOf(), block);
    if (text.empty()) continue;
    if (before != nullptr && !goes_on(*before, block)) out += "\n";
    out += text;
    before = &block;
  }
  return out;
}

Json to_json(const Blocks& blocks) {
  Json out = Json::array();
  for (const Block& block : blocks) out.push_back(std::visit(JsonOf(), block));
  return out;
}

void put(const Blocks& blocks, Outcome& outcome) {
  outcome.result["blocks"] = to_json(blocks);
  outcome.text = text_of(blocks);
}

}  // namespace plumb::offline::show
