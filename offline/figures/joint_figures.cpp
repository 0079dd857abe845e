// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "draw/panel.hpp"
#include "draw/sheet.hpp"
#include "figures/joint_residual.hpp"
#include "figures/words.hpp"

namespace plumb::offline::figures {
namespace {

using draw::Mark;
using draw::Tone;

constexpr std::size_t kMostPoints = 1000, kMostSmallPoints = 200;
constexpr double kOverMedian = 1.5;  // of the ranges of the joints: the locked scale
constexpr double kStandOut = 2.0;    // half-widths of the 95 % interval: far beyond chance

constexpr double angle_per(const JointResidual& joint) {
  return joint.turns ? 180.0 / std::numbers::pi : 1e3;
}
const char* angle_unit(const JointResidual& joint) { return joint.turns ? "deg" : "mm"; }
const char* small_unit(const JointResidual& joint) { return joint.turns ? "µrad" : "µm"; }

/// Holds the curve and all but the outermost hundredth of the points.
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
    return fmt::format("{} poses are too few to draw a mean of {}.", joint.poses.size(),
                       joint.name);
  if (at.most_times < kStandOut)
    return fmt::format(
        "Nothing that depends on the angle of {} stands out: the local mean stays "
        "within {} {} of zero, and chance explains it.",
        joint.name, draw::digits(1e6 * std::max(at.high->value, -at.low->value), 2),
        small_unit(joint));
  return fmt::format(
      "What is left at {} runs from {} {} near {:.0f} {} to {} {} near {:.0f} {}; "
      "its local mean explains {:.0f} % of the squared deviations.",
      joint.name, draw::digits(1e6 * at.low->value, 2), small_unit(joint),
      std::round(at.low->q * angle_per(joint)) + 0.0, angle_unit(joint),
      draw::digits(1e6 * at.high->value, 2), small_unit(joint),
      std::round(at.high->q * angle_per(joint)) + 0.0, angle_unit(joint),
      100.0 * removed_share(joint));
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

/// Returns how many points lie outside the panel and are drawn at its edge.
int draw_joint(const RunResults& results, const JointResidual& joint, std::size_t most, double size,
               draw::Panel& panel) {
  std::vector<draw::Point> low, high, middle;
  for (const auto& mean : joint.curve) {
    const double q = mean.q * angle_per(joint);
    middle.push_back({q, 1e6 * mean.value});
    if (!std::isfinite(mean.value)) continue;
    low.push_back({q, 1e6 * (mean.value - mean.half)});
    high.push_back({q, 1e6 * (mean.value + mean.half)});
  }
  panel.band(low, high, Tone::kBand);
  panel.line({{panel.x_low(), 0.0}, {panel.x_high(), 0.0}}, {.paint = Tone::kMuted});
  const double stride =
      std::max(1.0, static_cast<double>(joint.poses.size()) / static_cast<double>(most));
  int outside = 0;
  for (double at = 0.0; at < static_cast<double>(joint.poses.size()); at += stride) {
    const auto& pose = joint.poses[static_cast<std::size_t>(at)];
    Mark mark = joint_mark(pose, size);
    mark.pose = results.pose(pose.row);
    mark.words =
        fmt::format("{}: {} at {:.1f} {}, {} {}, error {}", mark.pose, joint.name,
                    pose.q * angle_per(joint), angle_unit(joint), draw::digits(1e6 * pose.value, 3),
                    small_unit(joint), length_text(results.after(pose.row)));
    const double y = std::clamp(1e6 * pose.value, panel.y_low(), panel.y_high());
    if (y != 1e6 * pose.value) ++outside;
    panel.mark(pose.q * angle_per(joint), y, mark);
  }
  panel.line(middle, {.paint = Tone::kPaper, .width = 4.0});
  panel.line(middle, {.paint = Tone::kInk, .width = 2.0});
  return outside;
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
  out.push_back({.words = "local mean", .line = draw::LineStyle{Tone::kInk, 2.0}});
  out.push_back({.words = "its 95 % interval", .area = Tone::kBand});
  return out;
}

std::vector<std::string> joint_notes(const RunResults& results) {
  auto out = error_notes(results);
  out.push_back(
      "Each point: by how much the joint would have to move to explain the error of its "
      "pose, which poses far from its axis show best; the mean is weighted accordingly. "
      "Outliers and repeats in a row are left out or averaged.");
  return out;
}

}  // namespace

std::string joint_figure(const RunResults& results, const JointResidual& joint, double width) {
  const double half = half_range(joint);
  auto notes = joint_notes(results);
  if (joint.poses.size() > kMostPoints)
    notes.push_back(fmt::format("An even choice of {} of {} points is drawn; the mean uses all.",
                                kMostPoints, joint.poses.size()));
  const auto is_outside = [&](const auto& pose) { return 1e6 * std::abs(pose.value) > half; };
  if (const auto n = std::count_if(joint.poses.begin(), joint.poses.end(), is_outside); n > 0)
    notes.push_back(
        fmt::format("{} of {} points lie beyond {} {}; those off the axis are drawn at "
                    "its edge.",
                    n, joint.poses.size(), draw::digits(half, 2), small_unit(joint)));
  draw::Sheet sheet(
      width, {.title = fmt::format("What the model leaves, as a deviation of {}", joint.name),
              .sentence = joint_sentence(joint),
              .legend = joint_legend(results, knows_sides(joint)),
              .notes = std::move(notes)});
  draw::Panel panel(
      sheet.svg(), sheet.room(390.0),
      {.title = fmt::format("position of {} [{}]", joint.name, angle_unit(joint)),
       .low = joint.poses.empty() ? 0.0 : joint.poses.front().q * angle_per(joint),
       .high = joint.poses.empty() ? 1.0 : joint.poses.back().q * angle_per(joint)},
      {.title = fmt::format("equivalent deviation of {} [{}]", joint.name, small_unit(joint)),
       .low = -half,
       .high = half});
  draw_joint(results, joint, kMostPoints, 3.2, panel);
  return sheet.file();
}

std::string joints_figure(const RunResults& results, double width) {
  const auto joints = joint_residuals(results);
  double half = 0.0;
  const JointResidual* first = nullptr;
  bool sides = false, thinned_out = false;
  for (const auto& joint : joints) {
    half = std::max(half, half_range(joint));
    const bool clear = extremes_of(joint).most_times >= kStandOut;
    if (first == nullptr || (clear && removed_share(joint) > removed_share(*first))) first = &joint;
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
  draw::Sheet sheet(width, {.title = "What the model leaves, as a deviation of each joint",
                            .sentence = first == nullptr ? "No joint moves in these poses."
                                                         : joint_sentence(*first),
                            .legend = joint_legend(results, sides),
                            .notes = std::move(notes)});
  const auto rooms = sheet.grid(static_cast<int>(joints.size()), 240.0, 210.0);
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const auto& joint = joints[k];
    draw::Panel panel(
        sheet.svg(), rooms[k],
        {.title = fmt::format("position [{}]", angle_unit(joint)),
         .low = joint.poses.front().q * angle_per(joint),
         .high = joint.poses.back().q * angle_per(joint)},
        {.title = fmt::format("deviation [{}]", small_unit(joint)), .low = -half, .high = half},
        joint.name);
    draw_joint(results, joint, kMostSmallPoints, 2.2, panel);
  }
  return sheet.file();
}

}  // namespace plumb::offline::figures
