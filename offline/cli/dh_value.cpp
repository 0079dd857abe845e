// SPDX-License-Identifier: Apache-2.0
#include "cli/dh_value.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>

#include "cell/units.hpp"
#include "import/number_text.hpp"
#include "import/unit_words.hpp"

namespace plumb::offline::cli {
namespace {

void replace_all(std::string& text, std::string_view what, std::string_view by) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
}

/// The text with Greek letters, signs and minus signs in ASCII and without blanks.
std::string plain(std::string_view text, bool comma) {
  using Signs = std::pair<std::string_view, std::string_view>;
  constexpr std::array kSigns{Signs{"π", "pi"}, Signs{"θ", "theta"}, Signs{"ϑ", "theta"},
                              Signs{"·", "*"},  Signs{"×", "*"},     Signs{"½", "0.5"}};
  std::string out(text);
  for (const auto& [sign, by] : kSigns) replace_all(out, sign, by);
  for (const auto minus : kMinus) replace_all(out, minus, "-");
  for (const auto blank : kBlanks) replace_all(out, blank, "");
  if (comma) std::replace(out.begin(), out.end(), ',', '.');
  return out;
}

/// value := [sign] term {sign term} [unit], term := factor {[* or /] factor}.
class ValueReader {
 public:
  explicit ValueReader(std::string text) : text_(std::move(text)), rest_(text_) {}

  std::optional<DhValue> read() {
    if (rest_.empty()) return std::nullopt;
    for (bool first = true; !rest_.empty(); first = false) {
      double sign = 1.0;
      if (took("-"))
        sign = -1.0;
      else if (!took("+") && !first)
        break;
      if (!term(sign)) return std::nullopt;
    }
    if (!rest_.empty() && !unit()) return std::nullopt;
    if (out_.of_pi && out_.unit.empty()) out_.unit = "rad";
    if (!std::isfinite(out_.value) || (out_.of_pi && out_.unit != "rad")) return std::nullopt;
    return out_;
  }

 private:
  bool took(std::string_view word) {
    if (!rest_.starts_with(word)) return false;
    rest_.remove_prefix(word.size());
    return true;
  }

  bool term(double sign) {
    if (variable()) return sign > 0.0;
    auto product = factor();
    if (!product) return false;
    for (;;) {
      const bool divide = took("/");
      const bool multiply = !divide && took("*");
      const auto next = divide || multiply || rest_.starts_with("pi") ? factor() : std::nullopt;
      if (!next && (divide || multiply)) return false;
      if (!next) break;
      *product = divide ? *product / *next : *product * *next;
    }
    out_.value += sign * *product;
    return true;
  }

  std::optional<double> factor() {
    if (took("(")) {
      const auto inside = factor();
      return inside && took(")") ? inside : std::nullopt;
    }
    if (took("pi") || took("PI") || took("Pi")) {
      out_.of_pi = true;
      return std::numbers::pi;
    }
    const auto number = take_number(rest_, '.');
    return number ? number_in(*number, '.') : std::nullopt;
  }

  /// q, q2, q_2, theta2: once.
  bool variable() {
    if (!took("theta") && !took("th") && !took("q") && !took("d")) return false;
    (void)took("_");
    const auto [end, error] =
        std::from_chars(rest_.data(), rest_.data() + rest_.size(), out_.of_joint);
    if (error == std::errc{}) rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    (void)took("*");
    return !std::exchange(out_.variable, true);
  }

  bool unit() {
    const std::string known = known_unit(std::string(rest_));
    const auto unit = unit_of(known);
    if (!unit || (unit->quantity != Quantity::kAngle && unit->quantity != Quantity::kLength))
      return false;
    out_.unit = known;
    return true;
  }

  std::string text_;
  std::string_view rest_;
  DhValue out_;
};

}  // namespace

std::optional<DhValue> read_dh_value(std::string_view text, bool comma) {
  if (const auto degrees = sexagesimal(text)) return DhValue{*degrees, "deg"};
  const std::string written = plain(text, comma);
  // Whether a comma divides thousands or is a decimal sign cannot be told between commas.
  return written.find(',') == written.npos ? ValueReader(written).read() : std::nullopt;
}

}  // namespace plumb::offline::cli
