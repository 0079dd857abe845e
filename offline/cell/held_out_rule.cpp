// SPDX-License-Identifier: Apache-2.0
#include <charconv>

#include "cell/cell.hpp"

namespace plumb::offline {
namespace {

constexpr int kMostFolds = 100;

template <class Number>
std::optional<Number> whole(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// What stands behind a prefix.
std::optional<std::string_view> behind(std::string_view text, std::string_view prefix) {
  if (!text.starts_with(prefix) || text.size() == prefix.size()) return std::nullopt;
  return text.substr(prefix.size());
}

}  // namespace

std::optional<double> parse_percent(std::string_view text) {
  if (!text.ends_with('%')) return std::nullopt;
  text.remove_suffix(1);
  const auto value = whole<double>(text);
  return value ? std::optional(*value / 100.0) : std::nullopt;
}

std::optional<HeldOutRule> parse_held_out(std::string_view text,
                                          const std::filesystem::path& directory) {
  using enum HeldOutRule::Kind;
  if (text == "auto") return HeldOutRule{};
  if (text == "column:set") return HeldOutRule{.kind = kColumn};
  if (const auto share = parse_percent(text); share && *share > 0.0 && *share < 1.0)
    return HeldOutRule{.kind = kShare, .share = *share};
  if (const auto count = behind(text, "kfold:"))
    if (const auto folds = whole<int>(*count); folds && *folds >= 2 && *folds <= kMostFolds)
      return HeldOutRule{.kind = kFolds, .folds = *folds};
  if (const auto file = behind(text, "file:"))
    return HeldOutRule{.kind = kFile, .file = (directory / *file).lexically_normal()};
  return std::nullopt;
}

}  // namespace plumb::offline
