// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "arm/effect_binding.hpp"
#include "cell/contexts.hpp"
#include "draw/panel.hpp"
#include "draw/sheet.hpp"
#include "figures/joint_law.hpp"
#include "figures/law_figures.hpp"
#include "figures/words.hpp"
#include "plumb/runtime/detail/loads.hpp"

namespace plumb::offline::figures {
namespace {

using draw::Mark;
using draw::Tone;

constexpr std::size_t kMostLoadPoints = 500;
constexpr int kLoadSteps = 60;  // of the curve of a fitted law
constexpr std::size_t kMostSigmas = 100;
constexpr int kFewLoadSteps = 9;
constexpr double kManyJumps = 4.0;  // times its range that a function of the load cannot travel
constexpr double kLoad95 = 1.96;
constexpr double kVaries = 1e-6;      // of the largest load
constexpr double kClearSpring = 3.0;  // standard errors of a slope
constexpr std::size_t kFewestLoads = 4;

struct Loaded {
  JointResidual::Pose pose;
  double load = 0.0;   // [N m] or [N]
  double law = 0.0;    // what the fitted spring adds [rad] or [m]
  double sigma = NAN;  // and how sure that is; NaN where nobody asked
};

struct Loading {
  std::vector<Loaded> poses;  // by load
  bool known = true;          // false: of 1 kg at the flange
  std::string law;            // names of the effects; empty: none
};

struct Line {
  double at_zero = 0.0, slope = 0.0, slope_se = 0.0;  // [rad], [rad/(N m)]
  double middle = 0.0, middle_se = 0.0;               // load in the middle
  double at(double load) const { return at_zero + slope * load; }
  double half(double load) const {
    return kLoad95 * std::hypot(middle_se, slope_se * (load - middle));
  }
};

Loading loading_of(const RunResults& results, const JointResidual& joint) {
  Loading out;
  format::Mechanics mechanics = mechanics_of(results.cell);
  out.known = mechanics.payload_kg > 0.0 || !mechanics.links.empty() ||
              results.measured.context.payload.rows() > 0;
  if (!out.known) mechanics.payload_kg = 1.0;
  const JointLaw law(results, joint.joint, JointLaw::Of::kLoad);
  out.law = law.names();
  const Chain chain(results.run.fit.calibration.state.arm.calibrated);
  const Transformd X_TF = from_pose(results.cell.nominal.tool).inverse();
  const auto& q = results.measured.q;
  ChainFrames frames;
  Loads loads;
  for (const auto& pose : joint.poses) {
    chain.frames({q.row(pose.row).data(), static_cast<std::size_t>(q.cols())}, frames);
    weigh(chain, frames, mechanics, results.cell.gravity, X_TF,
          context_at(results.measured.context, pose.row, {}).known, loads);
    Loaded one{.pose = pose, .load = loads.torque(joint.joint, chain, frames)};
    if (!std::isfinite(one.load)) continue;
    one.law = law.at_pose(pose.row);
    one.pose.value += one.law;
    out.poses.push_back(one);
  }
  std::stable_sort(out.poses.begin(), out.poses.end(),
                   [](const Loaded& a, const Loaded& b) { return a.load < b.load; });
  // The curve is sure enough with some of them.
  const std::size_t stride = 1 + out.poses.size() / kMostSigmas;
  for (std::size_t i = 0; i < out.poses.size(); i += stride)
    out.poses[i].sigma = law.with_sigma(out.poses[i].pose.row).sigma;
  return out;
}

bool varies(const Loading& all) {
  if (all.poses.size() < kFewestLoads) return false;
  const double low = all.poses.front().load, high = all.poses.back().load;
  return high - low > std::max(1e-9, kVaries * std::max(std::abs(low), std::abs(high)));
}

/// Weighted least squares.
Line line_of(const Loading& all) {
  double w = 0.0, wx = 0.0, wy = 0.0;
  for (const auto& at : all.poses)
    w += at.pose.weight, wx += at.pose.weight * at.load, wy += at.pose.weight * at.pose.value;
  Line out;
  if (!(w > 0.0)) return out;
  out.middle = wx / w;
  double xx = 0.0, xy = 0.0, left = 0.0, ww_xx = 0.0, ww = 0.0;
  for (const auto& at : all.poses) {
    const double x = at.load - out.middle;
    xx += at.pose.weight * x * x, xy += at.pose.weight * x * (at.pose.value - wy / w);
  }
  if (!(xx > 0.0)) return out;
  out.slope = xy / xx;
  out.at_zero = wy / w - out.slope * out.middle;
  for (const auto& at : all.poses) {
    const double x = at.load - out.middle, rest = at.pose.value - out.at(at.load);
    const double v = at.pose.weight * at.pose.weight * rest * rest;
    ww += v, ww_xx += v * x * x, left += v;
  }
  const auto n = static_cast<double>(all.poses.size());
  const double few = n / std::max(1.0, n - 2.0);  // [MacKinnon & White 1985] HC1
  out.slope_se = std::sqrt(few * ww_xx) / xx;
  out.middle_se = std::sqrt(few * ww) / w;
  return out;
}

const char* load_unit(const JointResidual& joint) { return joint.turns ? "N m" : "N"; }

std::string slope_text(const JointResidual& joint, double slope) {
  return fmt::format("{} {} per {}", draw::digits(1e6 * slope, 2), deviation_unit(joint),
                     load_unit(joint));
}

std::string load_sentence(const JointResidual& joint, const Loading& all, const Line& line) {
  if (!varies(all))
    return fmt::format(
        "The load on {} hardly changes in these {} poses: they cannot show whether it "
        "yields.",
        joint.name, joint.poses.size());
  if (!all.law.empty()) {
    double low = INFINITY, high = -INFINITY;
    Scatter whole, rest;
    for (const auto& at : all.poses) {
      low = std::min(low, at.law), high = std::max(high, at.law);
      whole.add(at.pose.weight, at.pose.value);
      rest.add(at.pose.weight, at.pose.value - at.law);
    }
    return fmt::format(
        "The fitted law of {} ({}) runs from {} to {} {} over {:.0f} to {:.0f} {}, and explains "
        "{:.0f} % of the scatter that would be there without it.",
        joint.name, all.law, draw::digits(1e6 * low, 2), draw::digits(1e6 * high, 2),
        deviation_unit(joint), std::round(all.poses.front().load) + 0.0,
        std::round(all.poses.back().load) + 0.0, load_unit(joint),
        100.0 * rest.explained_of(whole));
  }
  if (std::abs(line.slope) < kClearSpring * line.slope_se || !(line.slope_se > 0.0))
    return fmt::format(
        "What is left of {} does not follow its load: {}, with a standard error of "
        "{}.",
        joint.name, slope_text(joint, line.slope), draw::digits(1e6 * line.slope_se, 2));
  return fmt::format(
      "What is left of {} follows its load: {}, {:.0f} standard errors from zero; it "
      "yields, or the masses are wrong.",
      joint.name, slope_text(joint, line.slope), std::abs(line.slope) / line.slope_se);
}

struct LoadCurve {
  std::vector<draw::Point> middle, under, over;  // the last two: its 95 % interval
};

/// How many steps of the load the curve has: many if the law is a function of it, few if it also
/// depends on where the arm is.
int curve_steps(const Loading& all) {
  double jumps = 0.0, low = INFINITY, high = -INFINITY;
  for (std::size_t i = 0; i < all.poses.size(); ++i) {
    low = std::min(low, all.poses[i].law), high = std::max(high, all.poses[i].law);
    if (i > 0) jumps += std::abs(all.poses[i].law - all.poses[i - 1].law);
  }
  return jumps > kManyJumps * (high - low) ? kFewLoadSteps : kLoadSteps;
}

/// The fitted law as means over equal steps of the load, with its interval.
LoadCurve law_curve(const Loading& all) {
  const double low = all.poses.front().load, high = all.poses.back().load;
  const int steps = curve_steps(all);
  std::vector<draw::Point> middle, under, over;
  std::size_t at = 0;
  for (int k = 0; k < steps; ++k) {
    const double end = k + 1 == steps ? INFINITY : low + (high - low) * (k + 1) / steps;
    double n = 0.0, load = 0.0, value = 0.0, sigma = 0.0, sigmas = 0.0;
    for (; at < all.poses.size() && all.poses[at].load < end; ++at) {
      n += 1.0, load += all.poses[at].load, value += all.poses[at].law;
      if (std::isfinite(all.poses[at].sigma)) sigma += all.poses[at].sigma, sigmas += 1.0;
    }
    if (n == 0.0) continue;
    middle.push_back({load / n, 1e6 * value / n});
    if (sigmas == 0.0) continue;
    const double half = kLoad95 * sigma / sigmas;
    under.push_back({load / n, 1e6 * (value / n - half)});
    over.push_back({load / n, 1e6 * (value / n + half)});
  }
  return {std::move(middle), std::move(under), std::move(over)};
}

LoadCurve line_curve(const Loading& all, const Line& line) {
  std::vector<draw::Point> middle, under, over;
  for (int k = 0; k <= kLoadSteps; ++k) {
    const double x =
        all.poses.front().load + (all.poses.back().load - all.poses.front().load) * k / kLoadSteps;
    middle.push_back({x, 1e6 * line.at(x)});
    under.push_back({x, 1e6 * (line.at(x) - line.half(x))});
    over.push_back({x, 1e6 * (line.at(x) + line.half(x))});
  }
  return {std::move(middle), std::move(under), std::move(over)};
}

/// The range of the vertical axis [µrad] or [µm]: it holds zero, the law, and all points but the
/// outermost hundredth.
std::pair<double, double> range_of(const Loading& all) {
  std::vector<double> values;
  std::pair<double, double> out{0.0, 0.0};
  for (const auto& at : all.poses) {
    values.push_back(at.pose.value);
    out.first = std::min(out.first, at.law), out.second = std::max(out.second, at.law);
  }
  std::sort(values.begin(), values.end());
  return {1e6 * std::min(out.first, quantile_of(values, 0.005)),
          1e6 * std::max(out.second, quantile_of(values, 0.995))};
}

std::vector<std::string> load_notes(const RunResults& results, const Loading& all) {
  auto out = error_notes(results);
  if (!all.known)
    out.push_back(
        "The masses of this arm are not known: the load is that of 1 kg at the flange, "
        "in shape like that of a payload. Masses in cell.toml give the true one.");
  if (!all.law.empty())
    out.push_back(
        "To each point is added what the fitted law contributes to its pose; the scatter "
        "around the curve is what the model leaves.");
  if (all.poses.size() > kMostLoadPoints)
    out.push_back(fmt::format("An even choice of {} of {} points is drawn; the curve uses all.",
                              kMostLoadPoints, all.poses.size()));
  return out;
}

}  // namespace

bool load_varies(const RunResults& results, const JointResidual& joint) {
  return varies(loading_of(results, joint));
}

std::string load_figure(const RunResults& results, const JointResidual& joint, double width) {
  const Loading all = loading_of(results, joint);
  const Line line = line_of(all);
  const bool fitted = !all.law.empty(), shown = varies(all);
  const LoadCurve curve = !shown ? LoadCurve{} : fitted ? law_curve(all) : line_curve(all, line);
  const auto [low, high] = range_of(all);
  auto notes = load_notes(results, all);
  for (std::size_t i = 0; i < curve.over.size(); ++i)
    if (curve.over[i].y - curve.under[i].y > high - low) {
      notes.emplace_back(
          "The interval is wider than this axis: these poses can hardly tell the law from other "
          "numbers of the model, such as the zero of the joint.");
      break;
    }
  auto legend = pose_legend(results);
  if (shown) {
    legend.push_back({.words = fitted ? "fitted law" : "straight line through what is left",
                      .line = draw::LineStyle{Tone::kInk, 2.0}});
    legend.push_back({.words = "its 95 % interval", .area = Tone::kBand});
  }
  draw::Sheet sheet(width, {.title = fmt::format("Deviation of {} over the load on it", joint.name),
                            .sentence = load_sentence(joint, all, line),
                            .legend = std::move(legend),
                            .notes = std::move(notes)});
  const double alone = shown ? 0.0 : 1.0;  // [N m] around a load that does not change
  draw::Panel panel(
      sheet.svg(), sheet.room(380.0),
      {.title = fmt::format("{} of gravity on {} [{}]", joint.turns ? "torque" : "force",
                            joint.name, load_unit(joint)),
       .low = all.poses.empty() ? 0.0 : all.poses.front().load - alone,
       .high = all.poses.empty() ? 1.0 : all.poses.back().load + alone},
      {.title = fmt::format("equivalent deviation of {} [{}]", joint.name, deviation_unit(joint)),
       .low = low,
       .high = high});
  panel.band(curve.under, curve.over, Tone::kBand);
  panel.line({{panel.x_low(), 0.0}, {panel.x_high(), 0.0}}, {.paint = Tone::kMuted});
  const double stride =
      std::max(1.0, static_cast<double>(all.poses.size()) / static_cast<double>(kMostLoadPoints));
  for (double k = 0.0; k < static_cast<double>(all.poses.size()); k += stride) {
    const Loaded& at = all.poses[static_cast<std::size_t>(k)];
    Mark mark{.fill = at.pose.held ? Mark::Fill::kFilled : Mark::Fill::kHollow,
              .size = 3.0,
              .pose = results.pose(at.pose.row)};
    mark.words =
        fmt::format("{}: {} {}, {} {}", mark.pose, draw::digits(at.load, 3), load_unit(joint),
                    draw::digits(1e6 * at.pose.value, 3), deviation_unit(joint));
    panel.mark(at.load, std::clamp(1e6 * at.pose.value, panel.y_low(), panel.y_high()), mark);
  }
  panel.line(curve.middle, {.paint = Tone::kPaper, .width = 4.0});
  panel.line(curve.middle, {.paint = Tone::kInk, .width = 2.0});
  return sheet.file();
}

}  // namespace plumb::offline::figures
