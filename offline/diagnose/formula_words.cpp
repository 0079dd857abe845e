// SPDX-License-Identifier: Apache-2.0
#include "diagnose/formula_words.hpp"

#include <fmt/format.h>

#include <vector>

#include "cell/effect_arguments.hpp"
#include "cell/formula_reader.hpp"
#include "diagnose/few_digits.hpp"

namespace plumb::offline {
namespace {

constexpr double kMicro = 1e6;

/// "320 µrad", "12.3 µrad/(N m)"
std::string size_words(const FormulaNumber& number) {
  return fmt::format("{:g} µ{}", three_digits(number.value * kMicro), number.unit);
}

}  // namespace

std::string law_of(const FormulaOffer& offer) {
  const FormulaText text = formula_text(offer.entry);
  return text.target + " = " + text.expression;
}

std::string formula_sentence(const Cell& cell, const FormulaOffer& offer, std::size_t place) {
  std::vector<std::string> sizes;
  for (const auto& number : offer.numbers)
    sizes.push_back(fmt::format("{} = {}", number.name, size_words(number)));
  const std::string command =
      place == 0 ? "" : " Add it: plumb add " + adding_arguments(cell, offer.entry, {});
  return fmt::format("{}: {} ({}): held-out error {} -> {} mm.{}",
                     place == 0 ? "A law that fits" : "Another one", law_of(offer),
                     fmt::join(sizes, ", "), digits_mm(offer.before.mean),
                     digits_mm(offer.after.mean), command);
}

}  // namespace plumb::offline
