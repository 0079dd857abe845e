// SPDX-License-Identifier: Apache-2.0
#include "program/verb_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>

namespace plumb {
namespace {

constexpr std::uint64_t kMostSeed = 1ULL << 53;  // every whole number below is a double

template <class Number>
std::optional<Number> number_in(const std::string& text) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return value;
}

}  // namespace

WordRule::WordRule(CLI::Validator rule)
    : rule_(std::make_unique<CLI::Validator>(std::move(rule))) {}
WordRule::~WordRule() = default;
WordRule::WordRule(WordRule&&) noexcept = default;

WordRule whole_number_between(long low, long high) { return WordRule(CLI::Range(low, high)); }

WordRule number_between(double low, double high) {
  // CLI::Range lets "nan" pass, which is neither below the one nor above the other.
  const auto check = [low, high](std::string& text) -> std::string {
    const auto value = number_in<double>(text);
    if (value && *value >= low && *value <= high) return {};
    return fmt::format("{} is not a number from {:g} to {:g}", text, low, high);
  };
  return WordRule(CLI::Validator(check, fmt::format("[{:g} - {:g}]", low, high)));
}

WordRule greater_than_zero() {
  const auto check = [](std::string& text) -> std::string {
    const auto value = number_in<double>(text);
    if (value && std::isfinite(*value) && *value > 0.0) return {};
    return fmt::format("{} is not a number greater than 0", text);
  };
  return WordRule(CLI::Validator(check, "> 0"));
}

WordRule seed_number() {
  const auto check = [](std::string& text) -> std::string {
    const auto value = number_in<std::uint64_t>(text);
    if (value && *value <= kMostSeed) return {};
    return fmt::format("{} is not a whole number from 0 to 2^53", text);
  };
  return WordRule(CLI::Validator(check, ""));
}

WordRule one_of(const std::vector<std::string>& words, InHelp help) {
  CLI::Validator rule = CLI::IsMember(words);
  if (help == InHelp::kHidden) rule.description("");
  return WordRule(std::move(rule));
}

Option Option::type_name(const std::string& name) const {
  option_->type_name(name);
  return *this;
}

Option Option::check(const WordRule& rule) const {
  option_->check(rule.rule());
  return *this;
}

Option Option::required() const {
  option_->required();
  return *this;
}

Option Option::shows_default() const {
  option_->capture_default_str();
  return *this;
}

Option Option::delimiter(char between) const {
  option_->delimiter(between);
  return *this;
}

Option Option::one_value_each() const {
  option_->allow_extra_args(false);
  return *this;
}

Option Option::take_all() const {
  option_->take_all();
  return *this;
}

Option Option::needs(const Option& other) const {
  option_->needs(other.option_);
  return *this;
}

Option VerbOptions::add_flag(const std::string& names, bool& set, const std::string& help) {
  return Option(verb_->add_flag(names, set, help));
}

template <class Value>
Option VerbOptions::add_option(const std::string& names, Value& value, const std::string& help) {
  return Option(verb_->add_option(names, value, help));
}

Option VerbOptions::get_option(const std::string& name) const {
  return Option(verb_->get_option(name));
}

using Text = const std::string&;
template Option VerbOptions::add_option(Text, std::string&, Text);
template Option VerbOptions::add_option(Text, int&, Text);
template Option VerbOptions::add_option(Text, long&, Text);
template Option VerbOptions::add_option(Text, std::uint64_t&, Text);
template Option VerbOptions::add_option(Text, double&, Text);
template Option VerbOptions::add_option(Text, std::optional<std::string>&, Text);
template Option VerbOptions::add_option(Text, std::optional<std::uint64_t>&, Text);
template Option VerbOptions::add_option(Text, std::optional<double>&, Text);
template Option VerbOptions::add_option(Text, std::vector<std::string>&, Text);
template Option VerbOptions::add_option(Text, std::vector<double>&, Text);

}  // namespace plumb
