// SPDX-License-Identifier: Apache-2.0
#include "cli/number_rules.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>

namespace plumb::offline::cli {
namespace {

constexpr std::uint64_t kMostSeed = 1ULL << 53;  // every whole number below is a double

template <class Number>
bool read(const std::string& text, Number& value) {
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc{} && stop == end;
}

}  // namespace

CLI::Validator greater_than_zero() {
  const auto check = [](std::string& text) -> std::string {
    double value = 0.0;
    if (read(text, value) && std::isfinite(value) && value > 0.0) return {};
    return fmt::format("{} is not a number greater than 0", text);
  };
  return CLI::Validator(check, "> 0");
}

CLI::Validator seed_number() {
  const auto check = [](std::string& text) -> std::string {
    std::uint64_t value = 0;
    if (read(text, value) && value <= kMostSeed) return {};
    return fmt::format("{} is not a whole number from 0 to 2^53", text);
  };
  return CLI::Validator(check, "");
}

}  // namespace plumb::offline::cli
