// SPDX-License-Identifier: Apache-2.0
#include "formula/unit_text.hpp"

#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <cmath>

namespace plumb::offline {
namespace {

struct Atom {
  const char* name;
  Dimension dimension;
  double factor;
  const char* si;
};

constexpr Dimension kEnergy = kTorque;
constexpr double kHalfTurn_rad = 3.14159265358979323846;

constexpr Atom kAtoms[] = {
    {"m", kLength, 1.0, "m"},
    {"mm", kLength, 1e-3, "m"},
    {"um", kLength, 1e-6, "m"},
    {"rad", kNumberOnly, 1.0, "rad"},
    {"mrad", kNumberOnly, 1e-3, "rad"},
    {"urad", kNumberOnly, 1e-6, "rad"},
    {"deg", kNumberOnly, kHalfTurn_rad / 180.0, "rad"},
    {"kg", kMass, 1.0, "kg"},
    {"g", kMass, 1e-3, "kg"},
    {"s", kTime, 1.0, "s"},
    {"ms", kTime, 1e-3, "s"},
    {"min", kTime, 60.0, "s"},
    {"h", kTime, 3600.0, "s"},
    {"K", kTemperature, 1.0, "K"},
    {"degC", kTemperature, 1.0, "K"},
    {"N", kForce, 1.0, "N"},
    {"kN", kForce, 1e3, "N"},
    {"Nm", kTorque, 1.0, "N m"},
    {"J", kEnergy, 1.0, "J"},
    {"W", {{2, 1, -3, 0}}, 1.0, "W"},
    {"Pa", {{-1, 1, -2, 0}}, 1.0, "Pa"},
    {"Hz", {{0, 0, -1, 0}}, 1.0, "1/s"},
};

class UnitParser {
 public:
  explicit UnitParser(std::string_view text) : text_(text) {}

  std::variant<WrittenUnit, UnitError> parse() {
    WrittenUnit out;
    if (!product(out, 0)) return error_;
    if (at_ < text_.size()) return UnitError{at_, 1, "this does not belong to a unit"};
    return out;
  }

 private:
  static constexpr int kDeepest = 8;

  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  bool skip_blanks() {
    const std::size_t before = at_;
    while (peek() == ' ') ++at_;
    return at_ > before;
  }
  bool fail(std::size_t at, std::size_t length, std::string message, std::string word = {}) {
    error_ = {at, std::max<std::size_t>(1, length), std::move(message), std::move(word)};
    return false;
  }

  bool product(WrittenUnit& out, int depth) {
    skip_blanks();
    if (!factor(out, depth)) return false;
    for (;;) {
      skip_blanks();
      const char sign = peek();
      if (sign == '\0' || sign == ')') return true;
      if (sign == '*' || sign == '/') ++at_;
      skip_blanks();
      WrittenUnit next;
      if (!factor(next, depth)) return false;
      const bool over = sign == '/';
      out.dimension = over ? out.dimension / next.dimension : out.dimension * next.dimension;
      out.factor = over ? out.factor / next.factor : out.factor * next.factor;
      const bool group = over && next.si.find(' ') != std::string::npos && next.si.back() != ')';
      out.si += (over ? "/" : " ") + (group ? "(" + next.si + ")" : next.si);
    }
  }

  bool factor(WrittenUnit& out, int depth) {
    if (peek() == '(') {
      if (depth == kDeepest) return fail(at_, 1, "too many parentheses");
      ++at_;
      if (!product(out, depth + 1)) return false;
      if (peek() != ')') return fail(at_, 1, "a ')' is missing");
      ++at_;
      out.si = "(" + out.si + ")";
    } else if (!atom(out)) {
      return false;
    }
    return peek() != '^' || power(out);
  }

  bool atom(WrittenUnit& out) {
    const std::size_t first = at_;
    if (peek() == '1') {
      ++at_;
      out.si = "1";
      return true;
    }
    while (std::isalpha(static_cast<unsigned char>(peek())) != 0) ++at_;
    const std::string name(text_.substr(first, at_ - first));
    if (name.empty()) return fail(first, 1, "a unit is missing here");
    for (const auto& known : kAtoms)
      if (name == known.name) {
        out = {known.dimension, known.factor, known.si};
        return true;
      }
    return fail(first, name.size(), fmt::format("'{}' is no unit", name), name);
  }

  bool power(WrittenUnit& out) {
    const std::size_t first = ++at_;
    int power = 0;
    const auto [end, error] =
        std::from_chars(text_.data() + at_, text_.data() + text_.size(), power);
    if (error != std::errc{} || power == 0 || std::abs(power) > 9)
      return fail(first, 1, "a power is a whole number from -9 to 9");
    at_ = static_cast<std::size_t>(end - text_.data());
    if (out.si.find(' ') != std::string::npos && out.si.back() != ')') out.si = "(" + out.si + ")";
    out.dimension = raised(out.dimension, power);
    out.factor = std::pow(out.factor, power);
    out.si += fmt::format("^{}", power);
    return true;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  UnitError error_;
};

}  // namespace

std::variant<WrittenUnit, UnitError> parse_unit(std::string_view text) {
  return UnitParser(text).parse();
}

std::vector<std::string> formula_units() {
  std::vector<std::string> out;
  for (const auto& atom : kAtoms) out.emplace_back(atom.name);
  return out;
}

}  // namespace plumb::offline
