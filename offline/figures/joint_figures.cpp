// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "draw/panel.hpp"
#include "draw/sheet.hpp"
#include "figures/joint_law.hpp"
#include "figures/joint_residual.hpp"
#include "figures/words.hpp"
#include "numbers/tails.hpp"
#include "program/counted_words.hpp"

namespace plumb::offline::figures {
namespace {

using draw::Mark;
using draw::Tone;

constexpr std::size_t kMostPoints = 500, kMostSmallPoints = 200;  // of a figure, of a small one
constexpr double kOverMedian = 1.5;  // of the ranges of the joints: the locked scale
constexpr int kLawPoints = 181;      // of the curve of a fitted law
constexpr double kStandOut = 2.0;    // half-widths of the 95 % interval: far beyond chance

/// Half the height of the axis: it holds the curve and all points but the outermost hundredth.
double half_range(const JointResidual& joint) {
  std::vector<double> sizes;
  for (const auto& pose : joint.poses) sizes.push_back(std::abs(pose.value));
  std::sort(sizes.begin(), sizes.end());
  double out = quantile_of(sizes, 0.98);
  for (const auto& mean : joint.curve)
    if (std::isfinite(mean.value)) out = std::max(out, std::abs(mean.value) + mean.half);
  return 1e6 * out;
}

struct Extremes {
  const JointResidual::Mean* low = nullptr;
  const JointResidual::Mean* high = nullptr;
  double most_times = 0.0;  // |mean| in half-widths of its interval
};

Extremes extremes_of(const JointResidual& joint) {
  Extremes out;
  for (const auto& mean : joint.curve) {
    if (!std::isfinite(mean.value)) continue;
    if (out.low == nullptr || mean.value < out.low->value) out.low = &mean;
    if (out.high == nullptr || mean.value > out.high->value) out.high = &mean;
    out.most_times = std::max(out.most_times, std::abs(mean.value) / std::max(mean.half, 1e-15));
  }
  return out;
}

double removed_share(const JointResidual& joint) {
  if (!(joint.rms > 0.0)) return 0.0;
  return 1.0 - std::pow(joint.rms_without_curve / joint.rms, 2);
}

std::string joint_sentence(const JointResidual& joint) {
  const Extremes at = extremes_of(joint);
  if (at.low == nullptr)
    return fmt::format(
        "{} too few to draw a mean of {}.",
        counted_words(static_cast<long long>(joint.poses.size()), "pose is", "poses are"),
        joint.name);
  if (at.most_times < kStandOut)
    return fmt::format(
        "Nothing that depends on the angle of {} stands out: the local mean stays "
        "within {} {} of zero, and chance explains it.",
        joint.name, draw::digits(1e6 * std::max(at.high->value, -at.low->value), 2),
        deviation_unit(joint));
  return fmt::format(
      "What is left at {} runs from {} {} near {:.0f} {} to {} {} near {:.0f} {}; "
      "its local mean explains {:.0f} % of the squared deviations.",
      joint.name, draw::digits(1e6 * at.low->value, 2), deviation_unit(joint),
      std::round(at.low->q * position_per(joint)) + 0.0, position_unit(joint),
      draw::digits(1e6 * at.high->value, 2), deviation_unit(joint),
      std::round(at.high->q * position_per(joint)) + 0.0, position_unit(joint),
      100.0 * removed_share(joint));
}

bool stands_out(const JointResidual& joint) { return extremes_of(joint).most_times >= kStandOut; }

/// The joint whose local mean stands out and explains most; if none stands out, the one that is
/// nearest to it. Null without joints.
const JointResidual* joint_to_name(const std::vector<JointResidual>& joints) {
  const JointResidual* out = nullptr;
  for (const auto& joint : joints) {
    const auto is_more = [&] {
      if (stands_out(joint) != stands_out(*out)) return stands_out(joint);
      if (stands_out(joint)) return removed_share(joint) > removed_share(*out);
      return extremes_of(joint).most_times > extremes_of(*out).most_times;
    };
    if (out == nullptr || is_more()) out = &joint;
  }
  return out;
}

std::string joints_sentence(const std::vector<JointResidual>& joints) {
  const JointResidual* joint = joint_to_name(joints);
  if (joint == nullptr) return "No joint moves in these poses.";
  const Extremes at = extremes_of(*joint);
  if (at.low == nullptr || stands_out(*joint)) return joint_sentence(*joint);
  return fmt::format(
      "Nothing that depends on the position of a joint stands out: chance explains the local mean "
      "of each. The nearest to a finding is {}, with a mean within {} {} of zero.",
      joint->name, draw::digits(1e6 * std::max(at.high->value, -at.low->value), 2),
      deviation_unit(*joint));
}

bool knows_sides(const JointResidual& joint) {
  return std::any_of(joint.poses.begin(), joint.poses.end(),
                     [](const auto& pose) { return pose.side != 0; });
}

Mark joint_mark(const JointResidual::Pose& pose, double size) {
  return {.shape = pose.side < 0 ? draw::Shape::kDiamond : draw::Shape::kCircle,
          .paint = pose.side < 0 ? Tone::kOrange : Tone::kBlue,
          .fill = pose.held ? Mark::Fill::kFilled : Mark::Fill::kHollow,
          .size = size};
}

/// A curve through the points of a joint with its 95 % interval.
struct JointCurve {
  std::vector<JointResidual::Mean> points;
  const char* dashes = "";
};

void draw_band(const JointResidual& joint, const JointCurve& curve, draw::Panel& panel) {
  std::vector<draw::Point> low, high;
  for (const auto& mean : curve.points) {
    if (!std::isfinite(mean.value)) continue;
    low.push_back({mean.q * position_per(joint), 1e6 * (mean.value - mean.half)});
    high.push_back({mean.q * position_per(joint), 1e6 * (mean.value + mean.half)});
  }
  panel.band(low, high, Tone::kBand);
}

void draw_joint(const RunResults& results, const JointResidual& joint,
                const std::vector<JointCurve>& curves, std::size_t most, double size,
                draw::Panel& panel) {
  for (const auto& curve : curves) draw_band(joint, curve, panel);
  panel.line({{panel.x_low(), 0.0}, {panel.x_high(), 0.0}}, {.paint = Tone::kMuted});
  const double stride =
      std::max(1.0, static_cast<double>(joint.poses.size()) / static_cast<double>(most));
  std::vector<const JointResidual::Pose*> drawn;
  for (double at = 0.0; at < static_cast<double>(joint.poses.size()); at += stride)
    drawn.push_back(&joint.poses[static_cast<std::size_t>(at)]);
  // One kind after the other, the held-out ones on top.
  std::stable_sort(drawn.begin(), drawn.end(), [](const auto* a, const auto* b) {
    return std::pair(a->held, a->side) < std::pair(b->held, b->side);
  });
  for (const auto* one : drawn) {
    const auto& pose = *one;
    Mark mark = joint_mark(pose, size);
    mark.pose = results.pose(pose.row);
    mark.words = fmt::format("{}: {} at {:.1f} {}, {} {}, error {}", mark.pose, joint.name,
                             pose.q * position_per(joint), position_unit(joint),
                             draw::digits(1e6 * pose.value, 3), deviation_unit(joint),
                             length_text(results.after(pose.row)));
    const double y = std::clamp(1e6 * pose.value, panel.y_low(), panel.y_high());
    panel.mark(pose.q * position_per(joint), y, mark);
  }
  for (const auto& curve : curves) {
    std::vector<draw::Point> middle;
    for (const auto& mean : curve.points)
      middle.push_back({mean.q * position_per(joint), 1e6 * mean.value});
    panel.line(middle, {.paint = Tone::kPaper, .width = 4.0});
    panel.line(middle, {.paint = Tone::kInk, .width = 2.0, .dashes = curve.dashes});
  }
}

std::vector<draw::LegendEntry> joint_legend(const RunResults& results, bool sides) {
  std::vector<draw::LegendEntry> out;
  const auto entry = [&](const char* words, int side, bool held) {
    out.push_back({.words = words, .mark = joint_mark({.side = side, .held = held}, 3.5)});
  };
  for (const bool held : {true, false}) {
    if ((held ? results.held : results.fit).empty()) continue;
    if (sides) {
      entry(held ? "held out, came upward" : "fitted, came upward", 1, held);
      entry(held ? "held out, came downward" : "fitted, came downward", -1, held);
    } else {
      entry(held ? "held out" : "fitted", 0, held);
    }
  }
  return out;
}

void add_mean_legend(std::vector<draw::LegendEntry>& out) {
  out.push_back({.words = "local mean", .line = draw::LineStyle{Tone::kInk, 2.0}});
  out.push_back({.words = "its 95 % interval", .area = Tone::kBand});
}

/// The points of a joint as they would be without the law of the run, and the law through them.
struct WithLaw {
  JointResidual joint;
  std::vector<JointCurve> curves;  // one, or one for each side
  std::string names;               // empty: the run has no such law
  double low = 0.0, high = 0.0, explained = 0.0;
};

WithLaw with_law(const RunResults& results, const JointResidual& joint) {
  WithLaw out{.joint = joint, .curves = {{joint.curve}}, .names = {}};
  const JointLaw law(results, joint.joint, JointLaw::Of::kOwnPosition);
  if (law.empty() || joint.poses.size() < 2) return out;
  out.names = law.names();
  Scatter all, left;
  for (auto& pose : out.joint.poses) {
    left.add(pose.weight, pose.value);
    pose.value += law.at_pose(pose.row);
    all.add(pose.weight, pose.value);
  }
  out.explained = left.explained_of(all);
  const bool sides = law.has_sides() && knows_sides(joint);
  out.curves.clear();
  out.low = INFINITY, out.high = -INFINITY;
  const double from = joint.poses.front().q, to = joint.poses.back().q;
  for (const int side : sides ? std::vector{1, -1} : std::vector{0}) {
    JointCurve curve{.points = {}, .dashes = side < 0 ? "7 4" : ""};
    for (int k = 0; k < kLawPoints; ++k) {
      const double q = from + (to - from) * k / (kLawPoints - 1);
      const auto [value, sigma] = law.at(q, side);
      curve.points.push_back({q, value, kNormal95 * sigma});
      out.low = std::min(out.low, value), out.high = std::max(out.high, value);
    }
    out.curves.push_back(std::move(curve));
  }
  return out;
}

std::string law_sentence(const WithLaw& with) {
  const JointResidual& joint = with.joint;
  return fmt::format(
      "The fitted law of {} ({}) runs from {} to {} {} and explains {:.0f} % of the scatter "
      "that would be there without it.",
      joint.name, with.names, draw::digits(1e6 * with.low, 2), draw::digits(1e6 * with.high, 2),
      deviation_unit(joint), 100.0 * with.explained);
}

void add_curve_legend(const WithLaw& with, std::vector<draw::LegendEntry>& out) {
  if (with.names.empty()) return add_mean_legend(out);
  const bool sides = with.curves.size() > 1;
  out.push_back({.words = sides ? "fitted law, upward" : "fitted law",
                 .line = draw::LineStyle{Tone::kInk, 2.0}});
  if (sides) out.push_back({.words = "downward", .line = draw::LineStyle{Tone::kInk, 2.0, "7 4"}});
  out.push_back({.words = "its 95 % interval", .area = Tone::kBand});
}

std::vector<std::string> joint_notes(const RunResults& results) {
  auto out = error_notes(results);
  out.emplace_back(
      "Each point: by how much the joint would have to move to explain the error of its "
      "pose, which poses far from its axis show best; the mean is weighted accordingly. "
      "Outliers and repeats in a row are left out or averaged.");
  return out;
}

}  // namespace

const char* position_unit(const JointResidual& joint) { return joint.turns ? "deg" : "mm"; }
const char* deviation_unit(const JointResidual& joint) { return joint.turns ? "µrad" : "µm"; }
double position_per(const JointResidual& joint) {
  return joint.turns ? 180.0 / std::numbers::pi : 1e3;
}

std::string joint_figure(const RunResults& results, const JointResidual& residual, double width) {
  const WithLaw with = with_law(results, residual);
  const JointResidual& joint = with.joint;
  double half = half_range(joint);
  if (!with.names.empty()) half = std::max(half, 1e6 * std::max(with.high, -with.low));
  auto notes = joint_notes(results);
  if (!with.names.empty())
    notes.push_back(
        "To each point is added what the law contributes to its pose; the scatter of the points "
        "around the curve is what the model leaves. The interval is that of the fitted numbers.");
  if (joint.poses.size() > kMostPoints)
    notes.push_back(fmt::format("An even choice of {} of {} points is drawn; the curve uses all.",
                                kMostPoints, joint.poses.size()));
  const auto is_outside = [&](const auto& pose) { return 1e6 * std::abs(pose.value) > half; };
  if (const auto n = std::count_if(joint.poses.begin(), joint.poses.end(), is_outside); n > 0)
    notes.push_back(
        fmt::format("{} of {} points lie beyond {} {}; those off the axis are drawn at "
                    "its edge.",
                    n, joint.poses.size(), draw::digits(half, 2), deviation_unit(joint)));
  auto legend = joint_legend(results, knows_sides(joint));
  add_curve_legend(with, legend);
  draw::Sheet sheet(
      width,
      {.title = with.names.empty() ? "What the model leaves, as a deviation of " + joint.name
                                   : "Deviation of " + joint.name + ", with the law fitted to it",
       .sentence = with.names.empty() ? joint_sentence(joint) : law_sentence(with),
       .legend = std::move(legend),
       .notes = std::move(notes)});
  draw::Panel panel(
      sheet.svg(), sheet.room(390.0),
      {.title = fmt::format("position of {} [{}]", joint.name, position_unit(joint)),
       .low = joint.poses.empty() ? 0.0 : joint.poses.front().q * position_per(joint),
       .high = joint.poses.empty() ? 1.0 : joint.poses.back().q * position_per(joint)},
      {.title = fmt::format("equivalent deviation of {} [{}]", joint.name, deviation_unit(joint)),
       .low = -half,
       .high = half});
  draw_joint(results, joint, with.curves, kMostPoints, 3.2, panel);
  return sheet.file();
}

std::string joints_figure(const RunResults& results, double width) {
  const auto joints = joint_residuals(results);
  double half = 0.0;
  bool sides = false, thinned_out = false;
  for (const auto& joint : joints) {
    half = std::max(half, half_range(joint));
    sides = sides || knows_sides(joint);
    thinned_out = thinned_out || joint.poses.size() > kMostSmallPoints;
  }
  // The scale of those that the poses show well: a joint near the point is mostly noise.
  std::vector<double> halves;
  for (const auto& joint : joints) halves.push_back(half_range(joint));
  std::sort(halves.begin(), halves.end());
  if (halves.size() > 2) half = std::min(half, kOverMedian * halves[(halves.size() - 1) / 2]);
  auto notes = joint_notes(results);
  notes.emplace_back("All panels have one scale; points beyond it are drawn at its edge.");
  if (thinned_out)
    notes.push_back(
        fmt::format("At most {} points a joint are drawn, an even choice; the means use "
                    "all of them.",
                    kMostSmallPoints));
  auto legend = joint_legend(results, sides);
  add_mean_legend(legend);
  draw::Sheet sheet(width, {.title = "What the model leaves, as a deviation of each joint",
                            .sentence = joints_sentence(joints),
                            .legend = std::move(legend),
                            .notes = std::move(notes)});
  const auto rooms = sheet.grid(static_cast<int>(joints.size()), 240.0, 210.0);
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const auto& joint = joints[k];
    draw::Panel panel(
        sheet.svg(), rooms[k],
        {.title = fmt::format("position [{}]", position_unit(joint)),
         .low = joint.poses.front().q * position_per(joint),
         .high = joint.poses.back().q * position_per(joint)},
        {.title = fmt::format("deviation [{}]", deviation_unit(joint)), .low = -half, .high = half},
        joint.name);
    draw_joint(results, joint, {{joint.curve}}, kMostSmallPoints, 2.2, panel);
  }
  return sheet.file();
}

}  // namespace plumb::offline::figures
