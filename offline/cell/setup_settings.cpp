// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "cell/cell_sections.hpp"

namespace plumb::offline {
namespace {

constexpr const char* kSetupCode = "E-CELL-SETUP";

/// Reads one [[measurement.setup]]; those before it are in the draft.
class SetupReader {
 public:
  SetupReader(TomlTable& table, CellDraft& draft)
      : t_(table), draft_(draft), m_(draft.cell.measurement) {}

  void read() {
    out_.place = t_.place("this set-up");
    name();
    files();
    frame();
    target();
    t_.done();
    m_.setups.push_back(std::move(out_));
  }

 private:
  void name() {
    if (t_.node("name") == nullptr)
      return t_.missing("name", "give every set-up a name of its own: name = \"day 1\"");
    out_.name = t_.text_or("name", "");
    if (out_.name.empty()) t_.out_of_range("name", "a text that is not empty");
    if (index_of(out_.name) >= 0)
      t_.error(kSetupCode, fmt::format("two set-ups are called '{}'", out_.name), *t_.node("name"),
               "second one", "give every set-up a name of its own");
  }

  void files() {
    for (const auto& [text, node] : t_.texts("files")) {
      const auto file = (draft_.cell.directory / text).lexically_normal();
      const std::string other = owner_of(file);
      if (text.empty())
        t_.error("E-CELL-RANGE", fmt::format("'{}' names no file", t_.name("files")), *node,
                 "empty", "files = [\"day1.csv\"]");
      else if (!other.empty())
        t_.error(kSetupCode, fmt::format("'{}' is a file of set-up '{}' already", text, other),
                 *node, "second one",
                 "delete one, or name it in 'files' of [measurement] and give it a column 'setup'");
      else {
        out_.files.push_back(file);
        out_.named_at.push_back(t_.source().place(node->source(), "named here"));
      }
    }
  }

  /// The set-up that names `file`.
  std::string owner_of(const std::filesystem::path& file) const {
    const auto names = [&](const Setup& s) {
      return std::find(s.files.begin(), s.files.end(), file) != s.files.end();
    };
    for (const auto& setup : m_.setups)
      if (names(setup)) return setup.name;
    return names(out_) ? out_.name : "";
  }

  int index_of(const std::string& name) const {
    for (std::size_t k = 0; k < m_.setups.size(); ++k)
      if (m_.setups[k].name == name) return static_cast<int>(k);
    return -1;
  }

  /// What [measurement] says holds where a set-up says nothing.
  void frame() {
    out_.fit_frame = m_.fit_frame;
    out_.X_MB = m_.X_MB;
    if (t_.node("frame") == nullptr || says_fit("frame", "{ xyz, rpy }", out_.fit_frame)) return;
    if (auto frame = t_.table("frame")) {
      out_.fit_frame = false;
      if (frame->node("same_as") != nullptr)
        out_.frame_of = same_as(*frame);
      else
        out_.X_MB = read_pose(*frame, draft_);
    }
  }

  void target() {
    out_.fit_target = m_.fit_target;
    out_.target_T = m_.target_T;
    if (t_.node("target") == nullptr || says_fit("target", "[x, y, z]", out_.fit_target)) return;
    out_.fit_target = false;
    if (t_.node("target")->is_table()) {
      if (auto target = t_.table("target")) out_.target_of = same_as(*target);
    } else if (const auto target = t_.vector3("target")) {
      for (int k = 0; k < 3; ++k) out_.target_T[k] = draft_.length.to_si((*target)[k]);
    }
  }

  bool says_fit(const std::string& key, const std::string& otherwise, bool& fitted) {
    const toml::node& node = *t_.node(key);
    if (!node.is_string()) return false;
    if (*node.value<std::string>() != "fit")
      t_.out_of_range(key, "\"fit\", " + otherwise + " or { same_as = \"another set-up\" }");
    fitted = true;
    return true;
  }

  std::optional<int> same_as(TomlTable& t) {
    std::optional<int> out;
    if (t.node("same_as") == nullptr)
      t.missing("same_as", "write: { same_as = \"day 1\" }");
    else if (const auto name = t.text("same_as")) {
      if (const int other = index_of(*name); other >= 0)
        out = other;
      else
        unknown(t, *name);
    }
    t.done();
    return out;
  }

  void unknown(TomlTable& t, const std::string& name) {
    std::vector<std::string> names;
    for (const auto& setup : m_.setups) names.push_back(setup.name);
    const auto guess = did_you_mean(name, names);
    t.error(kSetupCode, fmt::format("there is no set-up '{}' further up", name), *t.node("same_as"),
            guess               ? fmt::format("did you mean '{}'?", *guess)
            : name == out_.name ? "that is this one"
                                : "no set-up before this one has this name",
            names.empty() ? "the first set-up has none to share with: write \"fit\""
                          : fmt::format("set-ups further up: {}", fmt::join(names, ", ")));
  }

  TomlTable& t_;
  CellDraft& draft_;
  MeasurementSettings& m_;
  Setup out_;
};

}  // namespace

void read_setups(TomlTable& measurement, CellDraft& draft) {
  for (auto& table : measurement.tables("setup")) SetupReader(table, draft).read();
}

}  // namespace plumb::offline
