// SPDX-License-Identifier: Apache-2.0
#include "diagnose/formula_terms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "diagnose/constants.hpp"
#include "diagnose/few_digits.hpp"

namespace plumb::offline {
namespace {

using Shape = FormulaTerm::Shape;

/// "previous q2" and "q2" are 1, zero-based; -1 if it names no joint.
int joint_in(const std::string& name) {
  const std::string last = name.substr(name.find_last_of(' ') + 1);
  int out = 0;
  if (last.size() < 2 || last.front() != 'q') return -1;
  const auto [end, error] = std::from_chars(last.data() + 1, last.data() + last.size(), out);
  return error == std::errc{} && end == last.data() + last.size() ? out - 1 : -1;
}

bool is_past(const std::string& name) { return name.find(' ') != std::string::npos; }

const FormulaInput* named(const std::vector<FormulaInput>& all, const std::string& name) {
  const auto at =
      std::find_if(all.begin(), all.end(), [&](const FormulaInput& i) { return i.name == name; });
  return at == all.end() ? nullptr : &*at;
}

class InputList {
 public:
  explicit InputList(const WhitenedFit& s) : s_(s) {}

  template <class Get>
  void add(const std::string& name, const char* unit, const Get& get) {
    if (named(all_, name) != nullptr) return;
    FormulaInput input{name, unit, Eigen::ArrayXd(s_.poses())};
    for (Eigen::Index i = 0; i < s_.poses(); ++i) input.value(i) = get(i);
    if (input.value.allFinite() && input.value.maxCoeff() > input.value.minCoeff())
      all_.push_back(std::move(input));
  }
  void add_position(int j) {
    add(fmt::format("q{}", j + 1), "rad", [&](Eigen::Index i) { return s_.q(i)[j]; });
  }
  void add_approach(int j) {
    const auto at = static_cast<std::size_t>(j);
    add(fmt::format("dir{}", j + 1), "1", [&](Eigen::Index i) { return known(i).direction[at]; });
    add(fmt::format("travel{}", j + 1), s_.chain.revolute(j) ? "rad" : "m",
        [&](Eigen::Index i) { return known(i).travel[at]; });
  }
  void add_load(int j) {
    add(fmt::format("tau{}", j + 1), s_.chain.revolute(j) ? "N m" : "N", [&](Eigen::Index i) {
      const auto at = static_cast<std::size_t>(i);
      return s_.loads[at].torque(j, s_.chain, s_.frames[at]);
    });
  }
  void add_surroundings(const std::string& name) {
    if (name == "t") add(name, "s", [&](Eigen::Index i) { return known(i).time_s; });
    if (name == "payload") add(name, "kg", [&](Eigen::Index i) { return known(i).payload_kg; });
    const auto at = std::find(s_.sensors.begin(), s_.sensors.end(), name);
    if (at == s_.sensors.end()) return;
    const auto k = static_cast<std::size_t>(at - s_.sensors.begin());
    add(name, "degC", [&](Eigen::Index i) { return known(i).temperature_degC[k]; });
  }
  std::vector<FormulaInput> take() { return std::move(all_); }

 private:
  const Context& known(Eigen::Index i) const {
    return s_.context[static_cast<std::size_t>(i)].known;
  }
  const WhitenedFit& s_;
  std::vector<FormulaInput> all_;
};

struct Factor {
  std::string text;
  Eigen::ArrayXd value;
};

class TermList {
 public:
  TermList(const std::vector<FormulaInput>& inputs, const std::vector<FormulaInput>& over)
      : inputs_(inputs), over_(over) {}

  void add(const std::string& first, Shape shape, const Factor& f, const char* unit = "1") {
    if (f.value.size() > 0) all_.push_back({f.text, unit, first, shape, f.value});
  }
  /// The input as a factor; without values if it is not known.
  Factor input(const std::string& name) const {
    const FormulaInput* at = named(over_, name);
    return at == nullptr ? Factor{} : Factor{name, at->value};
  }
  /// A slowly varying number, from -1 to 1 over the series.
  Factor centred(const std::string& name) const {
    const FormulaInput& in = *named(inputs_, name);
    const double low = in.value.minCoeff(), high = in.value.maxCoeff();
    const double middle = with_digits(0.5 * (low + high), kFormulaDigits);
    const double half = with_digits(0.5 * (high - low), kFormulaDigits);
    return {fmt::format("(({} - {} [{}])/{} [{}])", name, middle, in.unit, half, in.unit),
            (named(over_, name)->value - middle) / half};
  }
  std::vector<FormulaTerm> take() { return std::move(all_); }

 private:
  const std::vector<FormulaInput>& inputs_;
  const std::vector<FormulaInput>& over_;
  std::vector<FormulaTerm> all_;
};

Factor times(const Factor& a, const Factor& b) {
  if (a.value.size() == 0 || b.value.size() == 0) return {};
  return {a.text + "*" + b.text, a.value * b.value};
}

std::string multiple(int h, const std::string& x) {
  return h == 1 ? x : fmt::format("{}*{}", h, x);
}
/// "(q4)"; a text in parentheses already has them.
std::string argument(const std::string& x) {
  const bool whole = x.front() == '(' && x.find(')') == x.size() - 1;
  return whole ? x : "(" + x + ")";
}

Factor sine(int h, const Factor& x) {
  return {"sin" + argument(multiple(h, x.text)), (h * x.value).sin()};
}
Factor cosine(int h, const Factor& x) {
  return {"cos" + argument(multiple(h, x.text)), (h * x.value).cos()};
}
std::vector<Factor> waves(int harmonics, const Factor& x) {
  std::vector<Factor> out;
  for (int h = 1; h <= harmonics; ++h) {
    out.push_back(sine(h, x));
    out.push_back(cosine(h, x));
  }
  return out;
}
std::vector<Factor> powers(const Factor& x) {
  return {x, {x.text + "^2", x.value.square()}, {x.text + "^3", x.value.cube()}};
}

void add_of_position(const std::string& name, const std::vector<Factor>& approaches,
                     TermList& out) {
  const Factor q = out.input(name);
  const auto with_approach = [&](const Factor& f, Shape shape) {
    out.add(name, shape, f);
    for (const Factor& dir : approaches) out.add(name, shape, times(f, dir));
  };
  for (const Factor& f : waves(kHarmonics, q)) with_approach(f, Shape::kWave);
  for (const Factor& f : powers(q)) with_approach(f, Shape::kPower);
  for (const Factor& f : {sine(1, q), cosine(1, q)})
    with_approach({"abs(" + f.text + ")", f.value.abs()}, Shape::kOther);
  with_approach({"exp(" + q.text + ")", q.value.exp()}, Shape::kOther);
  with_approach({"exp(-" + q.text + ")", (-q.value).exp()}, Shape::kOther);
}

void add_of_pair(const std::string& a, const std::string& b, const std::vector<Factor>& approaches,
                 TermList& out) {
  const Factor qa = out.input(a), qb = out.input(b);
  for (const Factor& f : waves(kFormulaHarmonicsOfPair, qa))
    for (const Factor& g : waves(kFormulaHarmonicsOfPair, qb)) {
      out.add(a, Shape::kWave, times(f, g));
      for (const Factor& dir : approaches) out.add(a, Shape::kWave, times(times(f, g), dir));
    }
  out.add(a, Shape::kPower, times(qa, qb));
  out.add(a, Shape::kPower, times({qa.text + "^2", qa.value.square()}, qb));
  out.add(a, Shape::kPower, times(qa, {qb.text + "^2", qb.value.square()}));
}

/// Of where the joint came from.
void add_of_past(int joint, TermList& out) {
  const Factor q = out.input(fmt::format("q{}", joint + 1));
  const Factor dir = out.input(fmt::format("dir{}", joint + 1));
  const Factor travel = out.input(fmt::format("travel{}", joint + 1));
  if (q.value.size() == 0 || dir.value.size() == 0) return;
  out.add(dir.text, Shape::kOther, dir);
  for (const Factor& f : waves(kFormulaHarmonicsOfPair, q))
    out.add(q.text, Shape::kWave, times(f, dir));
  for (const Factor& f : powers(q)) out.add(q.text, Shape::kPower, times(f, dir));
  if (travel.value.size() == 0) return;
  const Factor move = times(dir, travel);
  out.add(travel.text, Shape::kPower, move);
  for (const double range : kFormulaTravels_rad)
    out.add(travel.text, Shape::kOther,
            times(dir,
                  {fmt::format("exp(-{}/{})", travel.text, range), (-travel.value / range).exp()}));
  const Factor before{fmt::format("({} - {})", q.text, move.text), q.value - move.value};
  for (const Factor& f : waves(kHarmonics, before)) out.add(q.text, Shape::kWave, f);
  for (const Factor& f : powers(before)) out.add(q.text, Shape::kPower, f);
}

void add_of_surroundings(const Pattern& pattern, const std::string& name, TermList& out) {
  const Factor x = out.centred(name);
  for (const Factor& f : powers(x)) out.add(name, Shape::kPower, f);
  if (name != "t") return;
  for (const double share : kSettlingShares)
    out.add(name, Shape::kOther,
            {fmt::format("exp(-{}/{:g})", x.text, 2.0 * share), (-x.value / (2.0 * share)).exp()});
  if (!(pattern.harmonic > 0.0)) return;
  const std::string phase = fmt::format("{:g}*pi*{}", pattern.harmonic, x.text);
  const Eigen::ArrayXd turn = M_PI * pattern.harmonic * x.value;
  out.add(name, Shape::kWave, {"sin(" + phase + ")", turn.sin()});
  out.add(name, Shape::kWave, {"cos(" + phase + ")", turn.cos()});
}

}  // namespace

std::vector<FormulaInput> formula_inputs(const WhitenedFit& s, const Pattern& pattern) {
  InputList out(s);
  std::vector<int> joints;
  for (const auto& name : pattern.depends_on) {
    const int joint = joint_in(name);
    if (joint < 0 || joint >= s.joints()) {
      out.add_surroundings(name);
      continue;
    }
    joints.push_back(joint);
    out.add_position(joint);
  }
  if (!joints.empty() && pattern.joint >= 0) joints.push_back(pattern.joint);
  for (const int joint : joints) {
    out.add_approach(joint);
    out.add_load(joint);
  }
  return out.take();
}

std::vector<FormulaTerm> formula_terms(const Pattern& pattern,
                                       const std::vector<FormulaInput>& inputs,
                                       const std::vector<FormulaInput>& over) {
  TermList out(inputs, over);
  std::vector<std::string> angles;
  std::vector<Factor> approaches;
  for (const auto& input : over)
    if (input.name.starts_with("dir")) approaches.push_back(out.input(input.name));
  for (const auto& name : pattern.depends_on) {
    const int joint = joint_in(name);
    if (is_past(name))
      add_of_past(joint, out);
    else if (joint < 0 && named(inputs, name) != nullptr)
      add_of_surroundings(pattern, name, out);
    else if (named(inputs, name) != nullptr)
      angles.push_back(name);
  }
  for (const auto& name : angles) add_of_position(name, approaches, out);
  if (angles.size() > 1) add_of_pair(angles[0], angles[1], approaches, out);
  if (angles.empty()) return out.take();
  for (const auto& dir : approaches) out.add(dir.text, Shape::kOther, dir);
  for (const auto& input : over)
    if (input.name.starts_with("tau"))
      out.add(input.name, Shape::kOther, out.input(input.name), input.unit.c_str());
  return out.take();
}

}  // namespace plumb::offline
