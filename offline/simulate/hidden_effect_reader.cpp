// SPDX-License-Identifier: Apache-2.0
#include "simulate/hidden_effect_reader.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include "simulate/law_list.hpp"

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

/// Reads one specification of an effect and keeps track of the position for messages.
class Reader {
 public:
  Reader(const std::string& spec, const Cell& cell) : spec_(spec), cell_(cell) {}

  HiddenEffect read() {
    HiddenEffect out;
    end_ = std::min(spec_.find('@'), spec_.size());
    const std::size_t colon = find(':', 0);
    const auto [name, size] = name_and_size(0, colon);
    const sim::LawEntry& law = law_named(name);
    out.name = law.name;
    if (size.begin != size.end) add_size(size, law, out);
    if (colon < end_) read_joints(colon, law, out);
    if (end_ < spec_.size()) read_numbers(law, out);
    return out;
  }

 private:
  struct Span {
    std::size_t begin, end;
  };
  struct Item {
    Span name, size;
  };

  std::size_t find(char c, std::size_t from) const { return std::min(spec_.find(c, from), end_); }

  void read_joints(std::size_t colon, const sim::LawEntry& law, HiddenEffect& out) {
    const std::size_t second = find(':', colon + 1);
    if (law.on == sim::LawEntry::On::kArm && (second == end_ || second > colon + 1)) {
      fail(colon, 1, out.name + " works on the whole arm", "no joints here");
    }
    const bool skipped = second == colon + 1 && second < end_;
    for (std::size_t begin = colon + 1; !skipped && begin <= second;) {
      const std::size_t end = std::min(find(',', begin), second);
      add_joint(begin, end, law, out);
      begin = end + 1;
    }
    if (second < end_) add_sigma({second + 1, end_}, law, out);
  }

  // Reads the part "@KEY=NUMBER,...".
  void read_numbers(const sim::LawEntry& law, HiddenEffect& out) {
    std::size_t begin = end_ + 1;
    for (end_ = spec_.size(); begin <= end_;) {
      const std::size_t end = find(',', begin);
      const auto [key, value] = name_and_size(begin, end);
      if (std::find(law.keys.begin(), law.keys.end(), text(key)) == law.keys.end()) {
        fail(key, law.name + " has no number '" + text(key) + "'", suggestion(text(key), law.keys));
      }
      if (value.begin == value.end) fail(key, text(key) + " needs a number", "such as cycles=20");
      out.numbers[text(key)] = plain_number(value, "such as cycles=20");
      begin = end + 1;
    }
  }

  double plain_number(Span span, const std::string& help) const {
    double value = 0.0;
    const char* last = spec_.data() + span.end;
    const auto [rest, error] = std::from_chars(spec_.data() + span.begin, last, value);
    if (error != std::errc() || rest != last || !(value > 0.0) || !std::isfinite(value)) {
      fail(span, "a positive number stands here", help);
    }
    return value;
  }

  void add_sigma(Span span, const sim::LawEntry& law, HiddenEffect& out) const {
    if (law.size == Size::kNone) fail(span, law.name + " has no size", "remove it");
    const bool sized = std::any_of(out.joints.begin(), out.joints.end(),
                                   [](const auto& part) { return part.size.has_value(); });
    if (sized || out.size) fail(span, "there is a size already", "remove one of them");
    out.size_sigma = plain_number(span, "times the noise, such as 5");
  }

  void add_size(Span span, const sim::LawEntry& law, HiddenEffect& out) const {
    constexpr std::string_view kSigma = "sigma";
    if (text(span).ends_with(kSigma)) {
      return add_sigma({span.begin, span.end - kSigma.size()}, law, out);
    }
    out.size = size_of(span, law);
  }

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
    if (size.begin != size.end) {
      if (out.size_sigma) fail(size, "there is a size already", "remove one of them");
      part.size = size_of(size, law);
    }
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
    if (known.empty()) return "remove it";
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
  std::size_t end_ = 0;  // end of the part before '@'
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
