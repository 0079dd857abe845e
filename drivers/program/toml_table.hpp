// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <toml++/toml.h>

#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "program/problem_list.hpp"

namespace plumb {

/// The text of a TOML file and what was found wrong with it.
class TomlSource {
 public:
  /// The codes of its problems begin with `codes`: "E-CELL" gives E-CELL-KEY, E-CELL-RANGE ...
  TomlSource(std::string file, std::string text, std::string codes = "E-CELL");

  /// Throws Failure (kInput, E-TOML) if it is no TOML. Inline tables may run over several lines.
  toml::table parse();

  Place place(const toml::source_region& where, std::string label) const;
  ProblemList& problems() { return problems_; }
  std::string code(const char* what) const { return codes_ + "-" + what; }

  /// Throws Failure (kInput) with all errors, in the order of the file.
  void stop_on_errors();

 private:
  std::string file_;
  std::string text_;
  std::string codes_;
  std::string joined_;                     // as parsed: inline tables on one line
  std::vector<std::size_t> lines_;         // first character of each line of text_
  std::vector<std::size_t> joined_lines_;  // and of joined_
  ProblemList problems_;
};

/// One table read key by key. What nobody asked for is reported by `done`. A value of the wrong
/// type is reported and counts as absent.
class TomlTable {
 public:
  TomlTable(const toml::table& table, std::string path, TomlSource& source);

  const toml::node* node(const std::string& key);  // null if absent
  std::optional<double> number(const std::string& key);
  double number_or(const std::string& key, double fallback);
  std::optional<double> positive(const std::string& key);      // > 0
  std::optional<double> not_negative(const std::string& key);  // >= 0
  std::optional<std::string> text(const std::string& key);
  std::string text_or(const std::string& key, std::string fallback);
  std::string choice(const std::string& key, const std::vector<std::string>& words);
  std::optional<bool> boolean(const std::string& key);
  std::optional<std::array<double, 3>> vector3(const std::string& key);
  std::optional<std::array<double, 2>> pair(const std::string& key);
  std::optional<TomlTable> table(const std::string& key);
  std::vector<TomlTable> tables(const std::string& key);  // array of tables

  /// Texts of a list with the node each stands at.
  struct Text {
    std::string text;
    const toml::node* node;
  };
  std::vector<Text> texts(const std::string& key);

  std::vector<std::string> keys() const;  // in the order of the file

  void missing(const std::string& key, const std::string& help);

  /// Code RANGE at the value of `key`: "'robot.joints[1].q' must be …".
  void out_of_range(const std::string& key, const std::string& rule);

  void error(const std::string& code, const std::string& message, const toml::node& node,
             const std::string& label, const std::string& help);
  void warning(const std::string& code, const std::string& message, const toml::node& node,
               const std::string& label, const std::string& help);

  /// "robot.joints[1].q"
  std::string name(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }
  Place place(const std::string& label) const;  // of the table itself
  TomlSource& source() { return *source_; }

  /// Reports every key that was never asked for, with "did you mean".
  void done();

 private:
  void wrong_type(const std::string& key, const toml::node& node, const std::string& wanted);
  template <std::size_t N>
  std::optional<std::array<double, N>> numbers(const std::string& key, const char* wanted);

  const toml::table* table_;
  std::string path_;
  TomlSource* source_;
  std::set<std::string> known_;
};

}  // namespace plumb
