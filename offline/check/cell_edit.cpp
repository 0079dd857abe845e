// SPDX-License-Identifier: Apache-2.0
#include "check/cell_edit.hpp"

#include <fmt/format.h>

#include "cell/toml_text.hpp"
#include "program/toml_table.hpp"

namespace plumb::offline {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// The byte offset of a position in the text; its column counts characters, not bytes.
std::size_t offset_of(std::string_view text, const Place& place) {
  std::size_t at = text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
  for (int line = 1; line < place.line; ++line) at = text.find('\n', at) + 1;
  for (int column = 1; column < place.column; ++column) {
    ++at;
    while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U) ++at;
  }
  return at;
}

std::size_t end_of_string(std::string_view text, std::size_t at) {
  const char quote = text[at++];
  while (at < text.size() && text[at] != quote) at += text[at] == '\\' && quote == '"' ? 2 : 1;
  return std::min(at + 1, text.size());
}

/// The byte after the end of the list or inline table that begins at `at`.
std::size_t end_of_brackets(std::string_view text, std::size_t at) {
  int open = 0;
  while (at < text.size()) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      at = end_of_string(text, at);
      continue;
    }
    if (c == '#') at = std::min(text.find('\n', at), text.size());
    if (c == '[' || c == '{') ++open;
    if ((c == ']' || c == '}') && --open == 0) return at + 1;
    ++at;
  }
  return text.size();
}

std::size_t end_of_value(std::string_view text, std::size_t at) {
  const char c = text[at];
  if (c == '"' || c == '\'') return end_of_string(text, at);
  if (c == '[' || c == '{') return end_of_brackets(text, at);
  return std::min(text.find_first_of(", \t\r\n#]}", at), text.size());
}

class Editor {
 public:
  Editor(const std::string& text, const std::string& file)
      : text_(text), source_(file, text), root_(source_.parse()) {}

  std::string edit(const CellEdit& edit) {
    const auto robot = root_["robot"];
    const std::string unit = edit.angle_unit.value_or(robot["angle_unit"].value_or("deg"));
    if (edit.dh_convention) set("robot", "dh_convention", toml_string(*edit.dh_convention));
    if (edit.length_unit) set("robot", "length_unit", toml_string(*edit.length_unit));
    if (edit.angle_unit) set("robot", "angle_unit", toml_string(*edit.angle_unit));
    if (edit.coupling) set("robot", "coupling", *edit.coupling);
    for (const auto& [joint, theta] : edit.theta)
      set_joint(robot["joints"][static_cast<std::size_t>(joint)], "theta",
                text_in(*unit_of(unit), theta));
    for (const auto& [joint, offset] : edit.offset)
      set_joint(robot["joints"][static_cast<std::size_t>(joint)], "offset",
                text_in(*unit_of(unit), offset));
    if (edit.files) set("measurement", "files", toml_list(*edit.files));
    if (edit.prior_from) set("fit", "prior_from", toml_string(*edit.prior_from));
    if (edit.held_out) set("measurement", "held_out", toml_string(*edit.held_out));
    if (edit.frame) {
      const std::string length = edit.length_unit.value_or(robot["length_unit"].value_or("mm"));
      set("measurement", "frame", toml_pose(*edit.frame, *unit_of(length), *unit_of(unit)));
    }
    return apply();
  }

 private:
  struct Replacement {
    std::size_t size;
    std::string by;
  };

  std::size_t begin_of(const toml::node& node) const {
    return offset_of(text_, source_.place(node.source(), ""));
  }

  void replace(const toml::node& node, const std::string& by) {
    const std::size_t at = begin_of(node);
    replacements_.emplace(at, Replacement{end_of_value(text_, at) - at, by});
  }

  void set(const char* section, const char* key, const std::string& value) {
    if (const toml::node* node = root_[section][key].node()) return replace(*node, value);
    const toml::node* table = root_[section].node();
    if (table == nullptr) {
      replacements_.emplace(text_.size(),
                            Replacement{0, fmt::format("\n[{}]\n{} = {}\n", section, key, value)});
      return;
    }
    const std::size_t line = std::min(text_.find('\n', begin_of(*table)), text_.size() - 1) + 1;
    replacements_.emplace(line, Replacement{0, fmt::format("{} = {}\n", key, value)});
  }

  void set_joint(toml::node_view<toml::node> row, const char* key, const std::string& value) {
    if (const toml::node* node = row[key].node()) return replace(*node, value);
    if (const toml::node* node = row.node())
      replacements_.emplace(begin_of(*node) + 1,
                            Replacement{0, fmt::format(" {} = {},", key, value)});
  }

  std::string apply() const {
    std::string out = text_;
    for (auto r = replacements_.rbegin(); r != replacements_.rend(); ++r)
      out.replace(r->first, r->second.size, r->second.by);
    return out;
  }

  const std::string& text_;
  TomlSource source_;
  toml::table root_;
  std::multimap<std::size_t, Replacement> replacements_;  // by where they stand
};

}  // namespace

bool CellEdit::empty() const {
  return !dh_convention && !length_unit && !angle_unit && !coupling && theta.empty() &&
         offset.empty() && !files && !held_out && !prior_from && !frame;
}

std::string edited(const std::string& text, const std::string& file, const CellEdit& edit) {
  return Editor(text, file).edit(edit);
}

}  // namespace plumb::offline
