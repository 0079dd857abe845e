// SPDX-License-Identifier: Apache-2.0
#include "cell/toml_table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <sstream>

namespace plumb::offline {

TomlSource::TomlSource(std::string file, const std::string& text) : file_(std::move(file)) {
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines_.push_back(line);
}

Place TomlSource::place(const toml::source_region& where, std::string label) const {
  Place out{.file = file_, .label = std::move(label)};
  out.line = static_cast<int>(where.begin.line);
  out.column = static_cast<int>(where.begin.column);
  if (out.line >= 1 && out.line <= static_cast<int>(lines_.size()))
    out.source = lines_[out.line - 1];
  if (where.end.line == where.begin.line && where.end.column > where.begin.column)
    out.length = static_cast<int>(where.end.column - where.begin.column);
  return out;
}

void TomlSource::add(std::string code, std::string message, const toml::source_region& where,
                     std::string label, std::string help, Severity severity) {
  auto& list = severity == Severity::kError ? problems_ : remarks_;
  list.push_back({severity, std::move(code), std::move(message), place(where, std::move(label)),
                  std::move(help)});
}

void TomlSource::add(std::string code, std::string message, std::string help) {
  problems_.push_back({Severity::kError, std::move(code), std::move(message), Place{.file = file_},
                       std::move(help)});
}

TomlTable::TomlTable(const toml::table& table, std::string path, TomlSource& source)
    : table_(&table), path_(std::move(path)), source_(&source) {}

const toml::node* TomlTable::node(const std::string& key) {
  known_.insert(key);
  return table_->get(key);
}

bool TomlTable::has(const std::string& key) { return node(key) != nullptr; }

void TomlTable::wrong_type(const std::string& key, const toml::node& node, const char* wanted) {
  source_->add("E-CELL-TYPE", fmt::format("'{}' must be {}", name(key), wanted), node.source(),
               fmt::format("expected {}", wanted), "see: plumb explain E-CELL-TYPE");
}

std::optional<double> TomlTable::number(const std::string& key) {
  const toml::node* n = node(key);
  if (n == nullptr) return std::nullopt;
  const auto value = n->is_number() ? n->value<double>() : std::nullopt;
  if (!value) {
    wrong_type(key, *n, "a number");
    return std::nullopt;
  }
  if (!std::isfinite(*value)) {
    wrong(key, "is not a finite number", "NaN or infinite", "give the measured or nominal value");
    return std::nullopt;
  }
  return value;
}

double TomlTable::number_or(const std::string& key, double fallback) {
  return number(key).value_or(fallback);
}

std::optional<std::string> TomlTable::text(const std::string& key) {
  const toml::node* n = node(key);
  if (n == nullptr) return std::nullopt;
  if (!n->is_string()) {
    wrong_type(key, *n, "a text in quotes");
    return std::nullopt;
  }
  return n->value<std::string>();
}

std::string TomlTable::text_or(const std::string& key, std::string fallback) {
  return text(key).value_or(std::move(fallback));
}

std::optional<bool> TomlTable::boolean(const std::string& key) {
  const toml::node* n = node(key);
  if (n == nullptr) return std::nullopt;
  if (!n->is_boolean()) {
    wrong_type(key, *n, "true or false");
    return std::nullopt;
  }
  return n->value<bool>();
}

std::optional<std::vector<double>> TomlTable::numbers(const std::string& key, std::size_t count) {
  const toml::node* n = node(key);
  if (n == nullptr) return std::nullopt;
  const toml::array* array = n->as_array();
  std::vector<double> out;
  if (array != nullptr)
    for (const auto& element : *array)
      if (const auto value = element.is_number() ? element.value<double>() : std::nullopt;
          value && std::isfinite(*value))
        out.push_back(*value);
  if (array == nullptr || out.size() != count || array->size() != count) {
    wrong_type(key, *n,
               count == 3 ? "three finite numbers [x, y, z]" : "two finite numbers [min, max]");
    return std::nullopt;
  }
  return out;
}

std::optional<std::array<double, 3>> TomlTable::vector3(const std::string& key) {
  const auto v = numbers(key, 3);
  if (!v) return std::nullopt;
  return std::array<double, 3>{(*v)[0], (*v)[1], (*v)[2]};
}

std::optional<std::array<double, 2>> TomlTable::pair(const std::string& key) {
  const auto v = numbers(key, 2);
  if (!v) return std::nullopt;
  return std::array<double, 2>{(*v)[0], (*v)[1]};
}

std::vector<std::string> TomlTable::texts(const std::string& key) {
  std::vector<std::string> out;
  const toml::node* n = node(key);
  if (n == nullptr) return out;
  if (const toml::array* array = n->as_array())
    for (const auto& element : *array)
      if (element.is_string()) out.push_back(*element.value<std::string>());
  if (!n->is_array() || out.size() != n->as_array()->size()) wrong_type(key, *n, "a list of texts");
  return out;
}

std::optional<TomlTable> TomlTable::table(const std::string& key) {
  const toml::node* n = node(key);
  if (n == nullptr) return std::nullopt;
  if (!n->is_table()) {
    wrong_type(key, *n, "a table");
    return std::nullopt;
  }
  return TomlTable(*n->as_table(), name(key), *source_);
}

std::vector<TomlTable> TomlTable::tables(const std::string& key) {
  std::vector<TomlTable> out;
  const toml::node* n = node(key);
  if (n == nullptr) return out;
  const toml::array* array = n->as_array();
  if (array == nullptr) {
    wrong_type(key, *n, "a list of tables");
    return out;
  }
  for (std::size_t i = 0; i < array->size(); ++i) {
    if (const toml::table* element = array->get(i)->as_table())
      out.emplace_back(*element, fmt::format("{}[{}]", name(key), i + 1), *source_);
    else
      wrong_type(key, *array->get(i), "a table { … }");
  }
  return out;
}

std::vector<std::string> TomlTable::keys() const {
  std::vector<std::string> out;
  for (const auto& [key, value] : *table_) out.emplace_back(key.str());
  return out;
}

void TomlTable::missing(const std::string& key, const std::string& help) {
  source_->add("E-CELL-MISSING", fmt::format("'{}' is missing", name(key)), table_->source(),
               "belongs here", help);
}

void TomlTable::wrong(const std::string& key, const std::string& message, const std::string& label,
                      const std::string& help) {
  const toml::node* n = node(key);
  source_->add("E-CELL-RANGE", fmt::format("'{}' {}", name(key), message),
               n != nullptr ? n->source() : table_->source(), label, help);
}

void TomlTable::range(const std::string& key, bool ok, const std::string& rule) {
  if (!ok) wrong(key, "must be " + rule, rule, "see: plumb explain E-CELL-RANGE");
}

void TomlTable::done() {
  for (const auto& [key, value] : *table_) {
    const std::string text(key.str());
    if (known_.contains(text)) continue;
    const auto guess = did_you_mean(text, {known_.begin(), known_.end()});
    source_->add("E-CELL-KEY", fmt::format("unknown key '{}'", name(text)), key.source(),
                 guess ? fmt::format("did you mean '{}'?", *guess) : "not known here",
                 guess ? fmt::format("rename it to {}", *guess) : "delete it");
  }
}

}  // namespace plumb::offline
