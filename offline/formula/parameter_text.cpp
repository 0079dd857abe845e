// SPDX-License-Identifier: Apache-2.0
#include "formula/parameter_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "formula/names.hpp"

namespace plumb::offline {
namespace {

class ParameterParser {
 public:
  ParameterParser(const std::string& text, std::size_t index, FormulaProblems& problems)
      : text_(text), index_(index), problems_(problems) {}

  ParameterText parse() {
    ParameterText out;
    out.sound = name(out) && unit(out) && sizes(out);
    return out;
  }

 private:
  bool fail(FormulaProblem::Kind kind, std::size_t at, std::size_t length, std::string message,
            std::string label) {
    problems_.push_back({.kind = kind,
                         .field = FormulaProblem::Field::kParameter,
                         .parameter = index_,
                         .at = at,
                         .length = std::max<std::size_t>(1, length),
                         .message = std::move(message),
                         .label = std::move(label),
                         .help = "\"k [rad/(N m)] ~ 1e-6\": name, unit, typical size"});
    return false;
  }
  bool wrong(std::size_t at, std::size_t length, std::string message, std::string label) {
    return fail(FormulaProblem::Kind::kParameter, at, length, std::move(message), std::move(label));
  }

  void skip_blanks() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }
  bool take(char sign) {
    skip_blanks();
    if (at_ >= text_.size() || text_[at_] != sign) return false;
    ++at_;
    return true;
  }

  bool name(ParameterText& out) {
    skip_blanks();
    const std::size_t first = at_;
    at_ = std::min(text_.find_first_of(" [~=", at_), text_.size());
    const std::string name = text_.substr(first, at_ - first);
    if (!is_plain_name(name))
      return wrong(first, name.size(), fmt::format("'{}' is no name for a parameter", name),
                   "letters, digits and _");
    if (is_reserved(name))
      return wrong(first, name.size(), fmt::format("'{}' is a name of its own in formulas", name),
                   "choose another");
    out.name = name;
    return true;
  }

  bool unit(ParameterText& out) {
    if (!take('['))
      return wrong(at_, 1, fmt::format("parameter '{}' has no unit", out.name),
                   "[1] if it has none");
    const std::size_t first = at_, end = text_.find(']', at_);
    if (end == std::string::npos) return wrong(first - 1, 1, "a unit has no end", "']' is missing");
    const auto read = parse_unit(std::string_view(text_).substr(first, end - first));
    at_ = end + 1;
    if (const auto* error = std::get_if<UnitError>(&read)) {
      fail(FormulaProblem::Kind::kUnit, first + error->at, error->length, error->message,
           "unknown unit");
      problems_.back().word = error->word;
      problems_.back().candidates = formula_units();
      return false;
    }
    out.unit = std::get<WrittenUnit>(read);
    return true;
  }

  std::optional<double> number() {
    skip_blanks();
    double out = 0.0;
    const char* first = text_.data() + at_;
    const auto [end, error] = std::from_chars(first, text_.data() + text_.size(), out);
    if (error != std::errc{} || !std::isfinite(out)) return std::nullopt;
    at_ += static_cast<std::size_t>(end - first);
    return out;
  }

  bool sizes(ParameterText& out) {
    if (!take('~'))
      return wrong(at_, 1, fmt::format("parameter '{}' has no typical size", out.name), "~ 1e-6");
    skip_blanks();
    const std::size_t first = at_;
    const auto typical = number();
    if (!typical || !(*typical > 0.0))
      return wrong(first, at_ - first, "a typical size is a number above 0", "here");
    out.typical = *typical * out.unit.factor;
    if (take('=')) {
      const auto start = number();
      if (!start) return wrong(at_, 1, "a start is a number", "here");
      out.start = *start * out.unit.factor;
    }
    skip_blanks();
    return at_ == text_.size() || wrong(at_, text_.size() - at_, "this does not belong here",
                                        "after name, unit, size and start");
  }

  const std::string& text_;
  std::size_t index_;
  FormulaProblems& problems_;
  std::size_t at_ = 0;
};

}  // namespace

std::vector<ParameterText> parse_parameters(const std::vector<std::string>& texts,
                                            FormulaProblems& problems) {
  std::vector<ParameterText> out;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    ParameterText one = ParameterParser(texts[i], i, problems).parse();
    for (const auto& other : out)
      if (!one.name.empty() && other.name == one.name)
        problems.push_back({.kind = FormulaProblem::Kind::kParameter,
                            .field = FormulaProblem::Field::kParameter,
                            .parameter = i,
                            .at = texts[i].find(one.name),
                            .length = one.name.size(),
                            .message = fmt::format("parameter '{}' is declared twice", one.name),
                            .label = "again",
                            .help = "delete one of them"});
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace plumb::offline
