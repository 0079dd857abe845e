// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <toml++/toml.h>
#include <array>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "cell/problem.hpp"

namespace plumb::offline {

/// The text of a TOML file and what was found wrong with it.
class TomlSource {
 public:
  TomlSource(std::string file, const std::string& text);

  /// A problem at a node; `node` may be null for the whole file.
  void add(std::string code, std::string message, const toml::source_region& where,
           std::string label, std::string help, Severity severity = Severity::kError);
  void add(std::string code, std::string message, std::string help);

  Place place(const toml::source_region& where, std::string label) const;
  const std::vector<Problem>& problems() const { return problems_; }
  std::vector<Problem>& remarks() { return remarks_; }

 private:
  std::string file_;
  std::vector<std::string> lines_;
  std::vector<Problem> problems_;  // errors
  std::vector<Problem> remarks_;   // warnings and notes
};

/// One table read key by key. What nobody asked for is reported by `done`.
class TomlTable {
 public:
  TomlTable(const toml::table& table, std::string path, TomlSource& source);

  bool has(const std::string& key);
  std::optional<double> number(const std::string& key);
  double number_or(const std::string& key, double fallback);
  std::optional<std::string> text(const std::string& key);
  std::string text_or(const std::string& key, std::string fallback);
  std::optional<bool> boolean(const std::string& key);
  std::optional<std::array<double, 3>> vector3(const std::string& key);
  std::optional<std::array<double, 2>> pair(const std::string& key);
  std::vector<std::string> texts(const std::string& key);
  std::optional<TomlTable> table(const std::string& key);
  std::vector<TomlTable> tables(const std::string& key);  // array of tables
  const toml::node* node(const std::string& key);         // marks it as known

  std::vector<std::string> keys() const;
  std::string path() const { return path_; }
  TomlSource& source() { return *source_; }

  void missing(const std::string& key, const std::string& help);
  void wrong(const std::string& key, const std::string& message, const std::string& label,
             const std::string& help);
  void range(const std::string& key, bool ok, const std::string& rule);

  /// Reports every key that was never asked for, with "did you mean".
  void done();

 private:
  std::string name(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }
  void wrong_type(const std::string& key, const toml::node& node, const char* wanted);
  std::optional<std::vector<double>> numbers(const std::string& key, std::size_t count);

  const toml::table* table_;
  std::string path_;
  TomlSource* source_;
  std::set<std::string> known_;
};

}  // namespace plumb::offline
