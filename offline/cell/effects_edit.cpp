// SPDX-License-Identifier: Apache-2.0
#include "cell/effects_edit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "cell/toml_text.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {
namespace {

using Lines = std::vector<std::string>;

Lines split_lines(const std::string& text) {
  Lines out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    out.push_back(text.substr(at, end - at));
    at = end;
  }
  if (!out.empty() && out.back().back() != '\n') out.back() += '\n';
  return out;
}

std::string_view trimmed(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t");
  return first == std::string_view::npos ? std::string_view() : line.substr(first);
}

bool is_header(const std::string& line) { return trimmed(line).starts_with('['); }
bool is_blank(const std::string& line) {
  return trimmed(line).find_first_not_of("\r\n") == std::string_view::npos;
}
bool is_comment(const std::string& line) { return trimmed(line).starts_with('#'); }

std::string joints_text(const Cell& cell, const EffectEntry& effect) {
  std::vector<std::string> names;
  for (const int joint : effect.joints) names.push_back(cell.nominal.joints[joint].name);
  return "joints = " + toml_list(names);
}

/// Puts `by` in place of "joints = [...]" on one line; false if the line has none.
bool replace_joints(std::string& line, const std::string& by) {
  const std::size_t key = line.find("joints");
  if (key == std::string::npos || is_comment(line)) return false;
  const std::size_t close = line.find(']', key);
  if (close == std::string::npos) return false;
  line.replace(key, close + 1 - key, by);
  return true;
}

class Editor {
 public:
  Editor(const Cell& cell, const std::vector<EffectEntry>& wanted)
      : cell_(cell),
        wanted_(wanted),
        lines_(split_lines(cell.text)),
        taken_(wanted.size(), false) {}

  std::string edit() {
    // From the last to the first, so that places stay right.
    std::vector<std::pair<const EffectEntry*, std::optional<std::size_t>>> found;
    for (const auto& old : cell_.effects) found.push_back({&old, match(old)});
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
      return a.first->place.line > b.first->place.line;
    });
    for (const auto& [old, index] : found) {
      if (is_geometry(old->name)) continue;
      if (!index)
        remove(*old);
      else if (wanted_[*index].joints != old->joints)
        set_joints(*old, wanted_[*index]);
    }
    for (std::size_t i = 0; i < wanted_.size(); ++i)
      if (!taken_[i] && !is_geometry(wanted_[i].name)) append(wanted_[i]);
    return fmt::format("{}", fmt::join(lines_, ""));
  }

 private:
  std::optional<std::size_t> match(const EffectEntry& old) {
    for (const bool same_joints : {true, false})
      for (std::size_t i = 0; i < wanted_.size(); ++i)
        if (!taken_[i] && wanted_[i].name == old.name && wanted_[i].options == old.options &&
            (!same_joints || wanted_[i].joints == old.joints)) {
          taken_[i] = true;
          return i;
        }
    return std::nullopt;
  }

  std::size_t line_of(const EffectEntry& old) const {
    return std::min(static_cast<std::size_t>(std::max(1, old.place.line)), lines_.size()) - 1;
  }

  /// Behind the last line of the table that begins at `first`; comments ahead of the next header
  /// belong to that one.
  std::size_t end_of_table(std::size_t first) const {
    std::size_t end = first + 1;
    while (end < lines_.size() && !is_header(lines_[end])) ++end;
    if (end == lines_.size()) return end;
    std::size_t comment = end;
    while (comment > first + 1 && is_comment(lines_[comment - 1])) --comment;
    return comment;
  }

  /// What was added is taken back to the letter: the blank line behind the table is not its own,
  /// unless another one stands ahead of it.
  void remove(const EffectEntry& old) {
    const std::size_t first = line_of(old);
    std::size_t end = is_header(lines_[first]) ? end_of_table(first) : first + 1;
    if (first > 0 && !is_blank(lines_[first - 1]))
      while (end > first + 1 && is_blank(lines_[end - 1])) --end;
    lines_.erase(lines_.begin() + static_cast<long>(first),
                 lines_.begin() + static_cast<long>(end));
  }

  void set_joints(const EffectEntry& old, const EffectEntry& wanted) {
    const std::size_t first = line_of(old);
    const std::string text = joints_text(cell_, wanted);
    if (!is_header(lines_[first])) {
      replace_joints(lines_[first], text);
      return;
    }
    for (std::size_t i = first + 1; i < end_of_table(first); ++i)
      if (replace_joints(lines_[i], text)) return;
    lines_.insert(lines_.begin() + static_cast<long>(first) + 1, text + "\n");
  }

  /// Behind the last table of [effects]; a table that gets company becomes a list.
  void append(const EffectEntry& fresh) {
    std::size_t last = lines_.size();
    bool company = false;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (!is_header(lines_[i])) continue;
      const std::string_view head = trimmed(lines_[i]);
      const std::size_t name = head.find_first_not_of("[ \t");
      if (!head.substr(name).starts_with("effects")) continue;
      last = end_of_table(i);
      const std::string key = "effects." + fresh.name;
      const std::string_view rest = head.substr(name);
      if (!rest.starts_with(key) || rest.find_first_of(" \t]") != key.size()) continue;
      company = true;
      if (!head.starts_with("[["))
        lines_[i] = "[[" + key + "]]" + std::string(rest.substr(rest.find(']') + 1));
    }
    while (last > 0 && last <= lines_.size() && is_blank(lines_[last - 1])) --last;
    if (!has_section()) {
      lines_.insert(lines_.end(), {"\n", "[effects]\n"});
      last = lines_.size();
    }
    lines_.insert(lines_.begin() + static_cast<long>(last), effect_text(cell_, fresh, company));
    lines_ = split_lines(fmt::format("{}", fmt::join(lines_, "")));
  }

  bool has_section() const {
    return std::any_of(lines_.begin(), lines_.end(), [](const std::string& line) {
      return is_header(line) && line.find("effects") != std::string::npos;
    });
  }

  const Cell& cell_;
  const std::vector<EffectEntry>& wanted_;
  Lines lines_;
  std::vector<bool> taken_;
};

/// The same effects, in whatever order.
bool same_effects(std::vector<EffectEntry> a, const std::vector<EffectEntry>& b) {
  if (a.size() != b.size()) return false;
  for (const auto& wanted : b) {
    const auto it = std::find_if(a.begin(), a.end(),
                                 [&](const EffectEntry& e) { return same_effect(e, wanted); });
    if (it == a.end()) return false;
    a.erase(it);
  }
  return true;
}

/// Whether `text` is a cell with these effects. What is wrong with them is thrown.
bool reads_as(const std::string& text, const Cell& cell, const std::vector<EffectEntry>& effects) {
  try {
    return same_effects(parse_cell(text, cell.file).effects, effects);
  } catch (const Failure& failure) {
    if (failure.problems().front().code != "E-TOML") throw;
    return false;
  }
}

}  // namespace

bool same_effect(const EffectEntry& a, const EffectEntry& b) {
  return a.name == b.name && a.joints == b.joints && a.options == b.options;
}

std::string effect_text(const Cell& cell, const EffectEntry& effect, bool several) {
  const std::string table = "effects." + effect.name;
  std::string out = several ? "[[" + table + "]]\n" : "[" + table + "]\n";
  if (!effect.joints.empty()) out += joints_text(cell, effect) + "\n";
  for (const auto& [key, value] : effect.options)
    out += fmt::format("{} = {}\n", key, toml_value(value));
  return out;
}

std::string edited_effects(const Cell& cell, const std::vector<EffectEntry>& effects) {
  std::string out = Editor(cell, effects).edit();
  if (reads_as(out, cell, effects)) return out;
  Problem problem{.code = "E-CELL-EFFECTS-LAYOUT",
                  .message = "[effects] is laid out in a way that cannot be edited in place",
                  .help = "write each effect as a table of its own: [effects.NAME]"};
  problem.place.emplace().file = cell.file.string();
  throw Failure(Exit::kInput, problem);
}

}  // namespace plumb::offline
