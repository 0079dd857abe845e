// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "diagnose/constants.hpp"
#include "diagnose/regressor.hpp"
#include "effects/effect_option.hpp"
#include "noise/moving_part.hpp"

namespace plumb::offline {
namespace {

/// A number known at every pose; patterns are built of them.
struct Input {
  std::string name;      // "q4"
  Eigen::ArrayXd value;  // (poses,)
  std::string plainly;   // "q4", "time", "the temperature temp_base"
};

double span_of(const Input& input) { return input.value.maxCoeff() - input.value.minCoeff(); }

bool known(const Eigen::ArrayXd& value) { return value.allFinite(); }

std::vector<Input> joint_inputs(const WhitenedFit& s) {
  std::vector<Input> out;
  for (int j = 0; j < s.joints(); ++j) {
    Input input{fmt::format("q{}", j + 1), Eigen::ArrayXd(s.poses()), {}};
    input.plainly = input.name;
    for (Eigen::Index i = 0; i < s.poses(); ++i) input.value(i) = s.q(i)[j];
    out.push_back(std::move(input));
  }
  return out;
}

/// A slowly varying number, scaled to -1 ... 1 over the series.
std::optional<Input> normalised(std::string name, std::string plainly, Eigen::ArrayXd value) {
  if (!known(value)) return std::nullopt;
  Input out{std::move(name), std::move(value), std::move(plainly)};
  const double span = span_of(out);
  if (!(span > 0.0)) return std::nullopt;
  out.value = (out.value - out.value.minCoeff()) * (2.0 / span) - 1.0;
  return out;
}

template <class Get>
Eigen::ArrayXd gathered(const WhitenedFit& s, const Get& get) {
  Eigen::ArrayXd out(s.poses());
  for (Eigen::Index i = 0; i < s.poses(); ++i) out(i) = get(s.context[i]);
  return out;
}

std::optional<Input> time_input(const WhitenedFit& s) {
  auto time =
      normalised("t", "time", gathered(s, [](const MeasuredContext& c) { return c.known.time_s; }));
  if (time) return time;
  return normalised("order", "the order of the poses",
                    gathered(s, [](const MeasuredContext& c) { return c.order; }));
}

std::vector<Input> surroundings(const WhitenedFit& s) {
  std::vector<Input> out;
  for (std::size_t k = 0; k < s.sensors.size(); ++k)
    if (auto input = normalised(
            s.sensors[k], "temperature " + s.sensors[k],
            gathered(s, [&](const MeasuredContext& c) { return c.known.temperature_degC[k]; })))
      out.push_back(std::move(*input));
  if (auto input = normalised("payload", "payload", gathered(s, [](const MeasuredContext& c) {
                                return c.known.payload_kg;
                              })))
    out.push_back(std::move(*input));
  return out;
}

Regressor on_joint(int joint, Pattern pattern, std::vector<Eigen::ArrayXd> shapes) {
  Regressor out;
  out.pattern = std::move(pattern);
  out.pattern.subject = fmt::format("joint {}", joint + 1);
  out.pattern.joint = joint;
  out.joint = joint;
  out.columns.resize(shapes.front().size(), static_cast<Eigen::Index>(shapes.size()));
  for (std::size_t c = 0; c < shapes.size(); ++c)
    out.columns.col(static_cast<Eigen::Index>(c)) = shapes[c] * kAngle_rad;
  out.typical = Eigen::VectorXd::Constant(out.columns.cols(), kAngle_rad);
  return out;
}

/// Twist of the base (6 columns) or shift of the tool (3), each times every shape.
Regressor on_body(const WhitenedFit& s, bool base, Pattern pattern,
                  const std::vector<Eigen::ArrayXd>& shapes) {
  Regressor out;
  out.pattern = std::move(pattern);
  out.pattern.subject = base ? kTheBase : kTheTool;
  const Eigen::MatrixXd& carriers = base ? s.base : s.tool;
  const auto count = static_cast<Eigen::Index>(shapes.size());
  out.columns.resize(carriers.rows(), carriers.cols() * count);
  out.typical.resize(out.columns.cols());
  for (Eigen::Index h = 0; h < count; ++h)
    for (Eigen::Index k = 0; k < carriers.cols(); ++k) {
      const Eigen::Index c = h * carriers.cols() + k;
      out.typical(c) = k < 3 ? kShift_m : kTurn_rad;
      for (Eigen::Index i = 0; i < s.poses(); ++i)
        out.columns.col(c).segment(s.table.begin(i), s.table.count(i)) =
            carriers.col(k).segment(s.table.begin(i), s.table.count(i)) *
            (shapes[h](i) * out.typical(c));
    }
  return out;
}

/// A joint that errs with the angle of another one, alone.
void visit_other_joints(const std::vector<Input>& q, const std::vector<int>& turning,
                        const RegressorVisitor& visit) {
  for (int k : turning)
    for (int h = 1; h <= kHarmonics; ++h) {
      if (span_of(q[k]) < kLeastForHarmonics_rad) continue;
      const Eigen::ArrayXd sin = (h * q[k].value).sin(), cos = (h * q[k].value).cos();
      for (int j : turning)
        if (j != k)
          visit(on_joint(j,
                         {{},
                          fmt::format("depends on {}, {} a turn", q[k].name,
                                      h == 1   ? "once"
                                      : h == 2 ? "twice"
                                               : "three times"),
                          {q[k].name},
                          static_cast<double>(h)},
                         {sin, cos}));
    }
}

/// An error of one joint that depends on the product of functions of two others.
void visit_pairs(const std::vector<Input>& q, const std::vector<int>& turning,
                 const RegressorVisitor& visit) {
  for (std::size_t x = 0; x < turning.size(); ++x)
    for (std::size_t y = x + 1; y < turning.size(); ++y) {
      const Input &a = q[turning[x]], &b = q[turning[y]];
      if (span_of(a) < kLeastForHarmonics_rad || span_of(b) < kLeastForHarmonics_rad) continue;
      const Eigen::ArrayXd sa = a.value.sin(), ca = a.value.cos(), sb = b.value.sin(),
                           cb = b.value.cos();
      const std::vector<Eigen::ArrayXd> shapes = {sa * sb, sa * cb, ca * sb, ca * cb};
      for (int j : turning)
        visit(on_joint(j,
                       {{},
                        fmt::format("depends on {} and {} together", a.name, b.name),
                        {a.name, b.name},
                        0.0},
                       shapes));
    }
}

void visit_surroundings(const WhitenedFit& s, const std::vector<int>& turning,
                        const RegressorVisitor& visit) {
  for (const auto& input : surroundings(s)) {
    const Pattern pattern{{}, "moves with the " + input.plainly, {input.name}, 0.0, true};
    for (int j : turning) visit(on_joint(j, pattern, {input.value}));
    visit(on_body(s, true, pattern, {input.value}));
    visit(on_body(s, false, pattern, {input.value}));
  }
  const auto time = time_input(s);
  if (!time) return;
  const Pattern pattern{{}, "moves with " + time->plainly, {time->name}, 0.0, true};
  for (int j : turning)
    visit(on_joint(j, pattern, {time->value, time->value.square() - 1.0 / 3.0}));
  visit(on_body(s, false, pattern, {time->value, time->value.square() - 1.0 / 3.0}));
  for (const double share : kSettlingShares) {
    const Pattern settling{{},
                           fmt::format("settles with {}, two thirds of it in {:g} % of the series",
                                       time->plainly, 100.0 * share),
                           {time->name},
                           0.0,
                           true};
    for (int j : turning)
      visit(on_joint(j, settling, {(-(time->value + 1.0) / (2.0 * share)).exp()}));
  }
}

void visit_periods(const WhitenedFit& s, const std::vector<int>& turning,
                   const RegressorVisitor& visit) {
  const auto time = time_input(s);
  if (!time) return;
  for (int half = 2; half <= kHalfPeriods; ++half) {
    const Eigen::ArrayXd phase = time->value * (0.5 * M_PI * half);
    const Pattern pattern{{},
                          fmt::format("moves to and fro with {}, {:g} times in the series",
                                      time->plainly, half / 2.0),
                          {time->name},
                          half / 2.0,
                          true};
    for (bool base : {true, false}) visit(on_body(s, base, pattern, {phase.sin(), phase.cos()}));
    if (half > kHalfPeriodsOfJoint) continue;
    for (int j : turning) visit(on_joint(j, pattern, {phase.sin(), phase.cos()}));
  }
}

/// The row of the stop before, whatever fold it is in; repeats of a pose are one stop.
int stop_before(const Measurements& measured, int row) {
  int before = row;
  while (before > 0 &&
         (measured.q.row(before) - measured.q.row(row)).cwiseAbs().maxCoeff() <= kNoMove)
    --before;
  return before;
}

/// Patterns by the stop before a pose.
void visit_history(const WhitenedFit& s, const std::vector<Input>& q,
                   const std::vector<int>& turning, const RegressorVisitor& visit) {
  for (int j : turning) {
    Eigen::ArrayXd before(s.poses());
    for (Eigen::Index i = 0; i < s.poses(); ++i)
      before(i) = s.measured->q(stop_before(*s.measured, s.row[i]), j);
    const Eigen::ArrayXd step = q[j].value - before;
    visit(on_joint(j,
                   {{},
                    "depends on where it stood one pose before",
                    {fmt::format("previous q{}", j + 1)},
                    1.0},
                   {before.sin(), before.cos()}));
    visit(on_joint(j, {{}, "depends on its own last move", {fmt::format("step q{}", j + 1)}, 0.0},
                   {step}));
    visit(on_joint(j,
                   {{},
                    "depends on the direction of its own last move",
                    {fmt::format("direction q{}", j + 1)},
                    0.0},
                   {step.sign()}));
  }
}

}  // namespace

Regressor pattern_of_part(const WhitenedFit& s, const EffectEntry& step, Pattern pattern,
                          const Eigen::ArrayXd& shape) {
  if (!step.joints.empty()) return on_joint(step.joints.front(), std::move(pattern), {shape});
  const bool base = text_option(step, OptionKey::kOf, "") == name_of(MotionSource::kBase);
  return on_body(s, base, std::move(pattern), {shape});
}

void visit_patterns(const WhitenedFit& s, const RegressorVisitor& visit) {
  std::vector<int> turning;
  for (int j = 0; j < s.joints(); ++j)
    if (s.chain.revolute(j)) turning.push_back(j);
  const auto q = joint_inputs(s);
  visit_other_joints(q, turning, visit);
  visit_pairs(q, turning, visit);
  visit_surroundings(s, turning, visit);
  visit_periods(s, turning, visit);
  visit_history(s, q, turning, visit);
}

}  // namespace plumb::offline
