// SPDX-License-Identifier: Apache-2.0
#include "program/toml_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace plumb {

TomlTable::TomlTable(const toml::table& table, std::string path, TomlSource& source)
    : table_(&table), path_(std::move(path)), source_(&source) {}

const toml::node* TomlTable::node(const std::string& key) {
  known_.insert(key);
  return table_->get(key);
}

std::optional<double> TomlTable::number(const std::string& key) {
  const toml::node* n = node(key);
  if (n == nullptr) return std::nullopt;
  const auto value = n->is_number() ? n->value<double>() : std::nullopt;
  if (!value)
    wrong_type(key, *n, "a number");
  else if (!std::isfinite(*value))
    out_of_range(key, "finite");
  else
    return value;
  return std::nullopt;
}

double TomlTable::number_or(const std::string& key, double fallback) {
  return number(key).value_or(fallback);
}

std::optional<double> TomlTable::positive(const std::string& key) {
  const auto value = number(key);
  if (!value || *value > 0.0) return value;
  out_of_range(key, "greater than 0");
  return std::nullopt;
}

std::optional<double> TomlTable::not_negative(const std::string& key) {
  const auto value = number(key);
  if (!value || *value >= 0.0) return value;
  out_of_range(key, "0 or more");
  return std::nullopt;
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

std::string TomlTable::choice(const std::string& key, const std::vector<std::string>& words) {
  const auto given = text(key);
  if (!given) return words.front();
  if (std::find(words.begin(), words.end(), *given) != words.end()) return *given;
  const auto guess = did_you_mean(*given, words);
  const std::string all = fmt::format("\"{}\"", fmt::join(words, "\", \""));
  error(source_->code("RANGE"), fmt::format("'{}' is \"{}\"", name(key), *given), *node(key),
        guess ? fmt::format("did you mean \"{}\"?", *guess) : "not one of " + all,
        fmt::format("{} = \"{}\"", key, guess.value_or(words.front())));
  return words.front();
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

template <std::size_t N>
std::optional<std::array<double, N>> TomlTable::numbers(const std::string& key,
                                                        const char* wanted) {
  const toml::node* n = node(key);
  if (n == nullptr) return std::nullopt;
  const toml::array* array = n->as_array();
  if (array == nullptr || array->size() != N) {
    wrong_type(key, *n, wanted);
    return std::nullopt;
  }
  std::array<double, N> out{};
  bool good = true;
  for (std::size_t i = 0; i < N; ++i) {
    const toml::node& element = *array->get(i);
    out[i] = element.is_number() ? element.value<double>().value_or(NAN) : NAN;
    if (std::isfinite(out[i])) continue;
    wrong_type(key, element, wanted);
    good = false;
  }
  return good ? std::optional(out) : std::nullopt;
}

std::optional<std::array<double, 3>> TomlTable::vector3(const std::string& key) {
  return numbers<3>(key, "three finite numbers [x, y, z]");
}

std::optional<std::array<double, 2>> TomlTable::pair(const std::string& key) {
  return numbers<2>(key, "two finite numbers [min, max]");
}

std::vector<TomlTable::Text> TomlTable::texts(const std::string& key) {
  std::vector<Text> out;
  const toml::node* n = node(key);
  if (n == nullptr) return out;
  if (!n->is_array()) {
    wrong_type(key, *n, "a list of texts");
    return out;
  }
  for (const auto& element : *n->as_array())
    if (element.is_string())
      out.push_back({*element.value<std::string>(), &element});
    else
      wrong_type(key, element, "a list of texts");
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
  for (std::size_t i = 0; i < array->size(); ++i)
    if (const toml::table* element = array->get(i)->as_table())
      out.emplace_back(*element, fmt::format("{}[{}]", name(key), i + 1), *source_);
    else
      wrong_type(key, *array->get(i), "a list of tables { … }");
  return out;
}

std::vector<std::string> TomlTable::keys() const {
  std::vector<std::tuple<unsigned, unsigned, std::string>> found;
  for (const auto& [key, value] : *table_)
    found.emplace_back(key.source().begin.line, key.source().begin.column, key.str());
  std::sort(found.begin(), found.end());
  std::vector<std::string> out;
  for (auto& [line, column, key] : found) out.push_back(std::move(key));
  return out;
}

Place TomlTable::place(const std::string& label) const {
  Place out = source_->place(table_->source(), label);
  if (out.line > 0) return out;
  return source_->place({{1, 1}, {1, 2}, nullptr}, label);
}

void TomlTable::missing(const std::string& key, const std::string& help) {
  source_->problems().error(source_->code("MISSING"), fmt::format("'{}' is missing", name(key)),
                            place("belongs here"), help);
}

void TomlTable::wrong_type(const std::string& key, const toml::node& n, const std::string& wanted) {
  error(source_->code("TYPE"), fmt::format("'{}' must be {}", name(key), wanted), n,
        "expected " + wanted, "plumb explain " + source_->code("TYPE"));
}

void TomlTable::out_of_range(const std::string& key, const std::string& rule) {
  const toml::node* n = node(key);
  error(source_->code("RANGE"), fmt::format("'{}' must be {}", name(key), rule), n ? *n : *table_,
        "out of range", "plumb explain " + source_->code("RANGE"));
}

void TomlTable::error(const std::string& code, const std::string& message, const toml::node& n,
                      const std::string& label, const std::string& help) {
  source_->problems().error(code, message, source_->place(n.source(), label), help);
}

void TomlTable::warning(const std::string& code, const std::string& message, const toml::node& n,
                        const std::string& label, const std::string& help) {
  source_->problems().warning(code, message, source_->place(n.source(), label), help);
}

void TomlTable::done() {
  for (const auto& [key, value] : *table_) {
    const std::string text(key.str());
    if (known_.contains(text)) continue;
    const auto guess = did_you_mean(text, {known_.begin(), known_.end()});
    source_->problems().error(
        source_->code("KEY"), fmt::format("unknown key '{}'", name(text)),
        source_->place(key.source(),
                       guess ? fmt::format("did you mean '{}'?", *guess) : "not known here"),
        guess ? fmt::format("rename it to '{}'", *guess)
              : fmt::format("delete it; known here: {}", fmt::join(known_, ", ")));
  }
}

}  // namespace plumb
