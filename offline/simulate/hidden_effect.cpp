// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include "simulate/law.hpp"

namespace plumb::offline {
namespace {

using Size = sim::LawEntry::Size;

struct Unit {
  const char* name;
  Size size;
  double si;
};
constexpr std::array kUnits{Unit{"um", Size::kLength, 1e-6},
                            Unit{"mm", Size::kLength, 1e-3},
                            Unit{"m", Size::kLength, 1.0},
                            Unit{"urad", Size::kAngle, 1e-6},
                            Unit{"mrad", Size::kAngle, 1e-3},
                            Unit{"rad", Size::kAngle, 1.0},
                            Unit{"deg", Size::kAngle, std::numbers::pi / 180.0}};

/// Reads one specification and remembers where it is for messages.
class Reader {
 public:
  Reader(const std::string& spec, const Cell& cell) : spec_(spec), cell_(cell) {}

  HiddenEffect read() {
    HiddenEffect out;
    const std::size_t colon = std::min(spec_.find(':'), spec_.size());
    const auto [name, size] = name_and_size(0, colon);
    const sim::LawEntry& law = law_named(name);
    out.name = law.name;
    if (size.begin != size.end) out.size = size_of(size, law);
    if (colon == spec_.size()) return out;
    if (!law.per_joint) fail(colon, 1, out.name + " works on the whole arm", "no joints here");
    for (std::size_t begin = colon + 1; begin <= spec_.size();) {
      const std::size_t end = std::min(spec_.find(',', begin), spec_.size());
      add_joint(begin, end, law, out);
      begin = end + 1;
    }
    return out;
  }

 private:
  struct Span {
    std::size_t begin, end;
  };
  struct Item {
    Span name, size;
  };

  Item name_and_size(std::size_t begin, std::size_t end) const {
    const std::size_t equals = spec_.find('=', begin);
    if (equals >= end) return {{begin, end}, {end, end}};
    if (equals + 1 == end) fail(equals, 1, "no size behind '='", "such as 150urad");
    return {{begin, equals}, {equals + 1, end}};
  }

  std::string text(Span span) const { return spec_.substr(span.begin, span.end - span.begin); }

  const sim::LawEntry& law_named(Span span) const {
    const std::string name = text(span);
    if (const auto* law = sim::find_law(name)) return *law;
    std::vector<std::string> names;
    for (const auto& law : sim::law_entries()) names.push_back(law.name);
    fail(span, "the simulator knows no effect '" + name + "'", suggestion(name, names));
  }

  void add_joint(std::size_t begin, std::size_t end, const sim::LawEntry& law, HiddenEffect& out) {
    const auto [span, size] = name_and_size(begin, end);
    std::vector<std::string> names;
    for (const auto& row : cell_.nominal.joints) names.push_back(row.name);
    const auto found = std::find(names.begin(), names.end(), text(span));
    if (found == names.end()) {
      fail(span, "the arm has no joint '" + text(span) + "'", suggestion(text(span), names));
    }
    HiddenEffect::Part part{static_cast<int>(found - names.begin()), std::nullopt};
    for (const auto& other : out.joints) {
      if (other.joint == part.joint) fail(span, text(span) + " is named twice", "remove it");
    }
    if (size.begin != size.end) part.size = size_of(size, law);
    out.joints.push_back(part);
  }

  double size_of(Span span, const sim::LawEntry& law) const {
    double value = 0.0;
    const char* first = spec_.data() + span.begin;
    const char* last = spec_.data() + span.end;
    const auto [rest, error] = std::from_chars(first, last, value);
    if (error != std::errc() || !(value > 0.0) || !std::isfinite(value)) {
      fail(span, "a size is a positive number with a unit", "such as 150urad");
    }
    if (law.size == Size::kNone) fail(span, law.name + " has no size", "remove it");
    const std::string name(rest, last);
    for (const auto& unit : kUnits) {
      if (name == unit.name && law.size == unit.size) return value * unit.si;
    }
    fail(span, "'" + name + "' is no unit for the size of " + law.name,
         law.size == Size::kAngle ? "use urad, mrad, rad or deg" : "use um, mm or m");
  }

  static std::string suggestion(const std::string& word, const std::vector<std::string>& known) {
    if (const auto near = did_you_mean(word, known)) return "did you mean '" + *near + "'?";
    std::string all;
    for (const auto& name : known) all += (all.empty() ? "" : ", ") + name;
    return "known: " + all;
  }

  [[noreturn]] void fail(Span span, const std::string& message, const std::string& help) const {
    fail(span.begin, std::max<std::size_t>(span.end - span.begin, 1), message, help);
  }

  [[noreturn]] void fail(std::size_t at, std::size_t length, const std::string& message,
                         const std::string& help) const {
    Place place{"--effect", 1, static_cast<int>(at) + 1, static_cast<int>(length), spec_, ""};
    throw Failure(Exit::kUsage, {Severity::kError, "E-SIM-EFFECT", message, place, help});
  }

  const std::string& spec_;
  const Cell& cell_;
};

}  // namespace

HiddenEffect parse_hidden_effect(const std::string& spec, const Cell& cell) {
  return Reader(spec, cell).read();
}

const std::vector<std::pair<std::string, std::string>>& simulated_effects() {
  static const auto lines = [] {
    std::vector<std::pair<std::string, std::string>> out;
    for (const auto& law : sim::law_entries()) out.emplace_back(law.name, law.line);
    return out;
  }();
  return lines;
}

}  // namespace plumb::offline
