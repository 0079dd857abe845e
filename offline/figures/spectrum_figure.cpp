// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "draw/panel.hpp"
#include "draw/sheet.hpp"
#include "figures/joint_law.hpp"
#include "figures/law_figures.hpp"
#include "figures/words.hpp"
#include "program/counted_words.hpp"

namespace plumb::offline::figures {
namespace {

using draw::Tone;

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr double kMostCycles = 200.0, kMostCyclesPerMetre = 400.0;  // of usual gears and screws
constexpr double kBeyondMotor = 2.2;                                // times a turn of the motor
constexpr double kMostEver = 1000.0;   // cycles: an encoder line is not a gear
constexpr double kOversampling = 4.0;  // frequencies in each that can be told apart
constexpr double kWork = 4e6;          // poses * frequencies in one spectrum
constexpr double kFinely = 8.0;        // as many frequencies more below so many waves in the range
constexpr double kLeastWaves = 0.75;   // in the range: less looks like a slope
constexpr double kSeen = 0.06;         // of the axis: a peak that is named
constexpr double kChance = 0.01;       // that noise exceeds Spectrum::chance anywhere
/// Least poses of a spectrum; peaks that are named; steps after which sines are computed anew.
constexpr std::size_t kFewestForSpectrum = 6, kNamed = 4, kResync = 64;

/// Weighted sums for one frequency, and the share that a wave with a free mean explains.
struct WaveSums {
  double w = 0.0, y = 0.0, yy = 0.0, c = 0.0, s = 0.0, cc = 0.0, cs = 0.0, yc = 0.0, ys = 0.0;

  double share() const {
    const double YY = yy - y * y / w, CC = cc - c * c / w, SS = (w - cc) - s * s / w;
    const double CS = cs - c * s / w, YC = yc - y * c / w, YS = ys - y * s / w;
    const double D = CC * SS - CS * CS;
    if (!(D > 1e-6 * w * w) || !(YY > 0.0)) return 0.0;
    return std::clamp((SS * YC * YC + CC * YS * YS - 2.0 * CS * YC * YS) / (YY * D), 0.0, 1.0);
  }
};

/// A pose, and its phase at the frequency that is looked at.
struct Wave {
  double w = 0.0, y = 0.0, q = 0.0;
  double c = 1.0, s = 0.0, turn_c = 1.0, turn_s = 0.0;
};

/// Shares at frequencies from `first` up to `last`, each phase turned on from the one before.
void scan(std::vector<Wave>& waves, double first, double last, double step, Spectrum& out) {
  for (Wave& at : waves) at.turn_c = std::cos(step * at.q), at.turn_s = std::sin(step * at.q);
  std::size_t k = 0;
  for (double f = first; f < last; f = first + step * static_cast<double>(++k)) {
    WaveSums sums;
    for (Wave& at : waves) {
      if (k % kResync == 0) {
        at.c = std::cos(f * at.q), at.s = std::sin(f * at.q);
      } else {
        const double c = at.c * at.turn_c - at.s * at.turn_s;
        at.s = at.s * at.turn_c + at.c * at.turn_s;
        at.c = c;
      }
      const double wy = at.w * at.y, wc = at.w * at.c;
      sums.w += at.w, sums.y += wy, sums.yy += wy * at.y;
      sums.c += wc, sums.s += at.w * at.s, sums.cc += wc * at.c, sums.cs += wc * at.s;
      sums.yc += wy * at.c, sums.ys += wy * at.s;
    }
    out.cycles.push_back(f);
    out.share.push_back(sums.share());
  }
}

/// An even choice of `most` of n.
std::vector<std::size_t> chosen(std::size_t n, std::size_t most) {
  std::vector<std::size_t> out;
  const double stride = std::max(1.0, static_cast<double>(n) / static_cast<double>(most));
  for (double at = 0.0; at < static_cast<double>(n); at += stride)
    out.push_back(static_cast<std::size_t>(at));
  return out;
}

double gear_ratio(const RunResults& results, int joint) {
  const auto& all = results.cell.mechanics;
  const auto j = static_cast<std::size_t>(joint);
  return j < all.size() ? std::abs(all[j].gear_ratio.value_or(0.0)) : 0.0;
}

std::string cycles_text(double cycles) {
  return cycles < 100.0 ? fmt::format("{:.1f}", cycles) : fmt::format("{:.0f}", cycles);
}

/// The frequency at place k of a spectrum in words. The first place stands for all slower waves,
/// too.
std::string cycles_at(const Spectrum& of, std::size_t k) {
  return (k == 0 ? "at most " : "") + cycles_text(of.cycles[k]);
}

std::string per_words(const JointResidual& joint) { return joint.turns ? "a turn" : "a metre"; }

struct Drawn {
  Spectrum left, before;  // before: without the law of the run; empty if there is none
  std::string law;
};

std::string spectrum_sentence(const JointResidual& joint, const Drawn& drawn) {
  if (drawn.left.cycles.empty())
    return fmt::format(
        "{} too few for a spectrum of {}, or it does not move.",
        counted_words(static_cast<long long>(joint.poses.size()), "pose is", "poses are"),
        joint.name);
  const auto left = peaks_of(drawn.left, kNamed), before = peaks_of(drawn.before, kNamed);
  std::string out;
  if (!before.empty()) {
    const auto k = before.front();
    out = fmt::format(
        "Without its fitted law, a wave of {} cycles {} would explain {:.0f} % of the "
        "deviations of {}; ",
        cycles_at(drawn.before, k), per_words(joint), 100.0 * drawn.before.share[k], joint.name);
    out += left.empty() ? "no wave is left beyond chance." : "";
    if (!left.empty())
      out += fmt::format("left is one of {}, with {:.0f} %.", cycles_at(drawn.left, left.front()),
                         100.0 * drawn.left.share[left.front()]);
    return out;
  }
  if (left.empty())
    return fmt::format("No wave of {} stands out: the highest share is what chance gives.",
                       joint.name);
  const auto k = left.front();
  return fmt::format(
      "A wave of {} cycles {} explains {:.0f} % of what is left of {}{}.", cycles_at(drawn.left, k),
      per_words(joint), 100.0 * drawn.left.share[k], joint.name,
      left.size() > 1 ? fmt::format("; {} more peaks are beyond chance", left.size() - 1) : "");
}

void draw_line(const Spectrum& of, const draw::LineStyle& style, draw::Panel& panel) {
  std::vector<draw::Point> points;
  for (std::size_t k = 0; k < of.cycles.size(); ++k) {
    // Where several frequencies fall into one pixel the highest share is drawn.
    const draw::Point here{of.cycles[k], 100.0 * of.share[k]};
    if (!points.empty() && panel.x_at(here.x) - panel.x_at(points.back().x) < 0.5)
      points.back().y = std::max(points.back().y, here.y);
    else
      points.push_back(here);
  }
  panel.line(points, style);
}

/// Peaks that are seen on this axis: where a large one is drawn too, small ones have no room.
void name_peaks(const Spectrum& of, Tone tone, draw::Panel& panel) {
  for (const std::size_t k : peaks_of(of, kNamed)) {
    const double x = of.cycles[k], y = 100.0 * of.share[k];
    if (y < kSeen * panel.y_high()) continue;
    panel.mark(x, y,
               {.shape = draw::Shape::kDiamond,
                .paint = tone,
                .size = 3.2,
                .words = fmt::format("k = {}: {:.1f} %", cycles_at(of, k), y)});
    panel.label(x, y, (k == 0 ? "k ≤ " : "k = ") + cycles_text(x),
                {.size = 11.0, .paint = tone, .halo = 3.0});
  }
}

}  // namespace

Spectrum spectrum_of(const JointResidual& joint, const std::vector<double>& value, double ratio) {
  Spectrum out;
  const std::size_t n = joint.poses.size();
  if (n < kFewestForSpectrum || value.size() != n) return out;
  const double unit = joint.turns ? kTwoPi : 1.0;
  const double range = (joint.poses.back().q - joint.poses.front().q) / unit;
  if (!(range > 0.0)) return out;
  const double most = std::min(
      kMostEver, std::max(joint.turns ? kMostCycles : kMostCyclesPerMetre, kBeyondMotor * ratio));
  out.apart = 1.0 / range;
  const double first = kLeastWaves / range, step = 1.0 / (kOversampling * range);
  const double fine = step / kFinely, finely_to = std::min(most, kFinely / range);
  if (first >= most) return out;
  const auto count = static_cast<std::size_t>((most - first) / step) + 1;
  const auto rows = chosen(
      n, std::max<std::size_t>(500, static_cast<std::size_t>(kWork / static_cast<double>(count))));
  out.points = static_cast<int>(rows.size());
  std::vector<Wave> waves;
  for (const std::size_t i : rows)
    waves.push_back({.w = joint.poses[i].weight,
                     .y = value[i],
                     .q = kTwoPi * (joint.poses[i].q - joint.poses.front().q) / unit});
  scan(waves, first, finely_to, fine, out);
  scan(waves, finely_to, most, step, out);
  // (1 - share)^((n - 3) / 2) is the chance of a share at one frequency, of which there are as many
  // as can be told apart. The weights make fewer poses of n.
  double w = 0.0, ww = 0.0;
  for (const Wave& at : waves) w += at.w, ww += at.w * at.w;
  const double independent = std::max(4.0, ww > 0.0 ? w * w / ww : 4.0);
  const double trials = std::max(1.0, (most - first) * range);
  out.chance = 1.0 - std::pow(kChance / trials, 2.0 / (independent - 3.0));
  return out;
}

std::vector<std::size_t> peaks_of(const Spectrum& of, std::size_t most) {
  std::vector<std::size_t> all, out;
  for (std::size_t k = 0; k < of.share.size(); ++k) {
    // The first one may stand for a slower wave, the last one is no peak.
    const bool rises = k == 0 || of.share[k] > of.share[k - 1];
    const bool falls = k + 1 < of.share.size() && of.share[k] >= of.share[k + 1];
    if (rises && falls && of.share[k] > of.chance) all.push_back(k);
  }
  std::stable_sort(all.begin(), all.end(),
                   [&](std::size_t a, std::size_t b) { return of.share[a] > of.share[b]; });
  for (const std::size_t k : all) {
    if (out.size() == most) break;
    // Beside a strong wave lie its own side lobes.
    if (std::none_of(out.begin(), out.end(), [&](std::size_t other) {
          return std::abs(of.cycles[k] - of.cycles[other]) < 2.0 * of.apart;
        }))
      out.push_back(k);
  }
  return out;
}

std::string spectrum_figure(const RunResults& results, const JointResidual& joint, double width) {
  const double ratio = gear_ratio(results, joint.joint);
  const JointLaw law(results, joint.joint, JointLaw::Of::kOwnPosition);
  std::vector<double> left, before;
  for (const auto& pose : joint.poses) {
    left.push_back(pose.value);
    if (!law.empty()) before.push_back(pose.value + law.at_pose(pose.row));
  }
  const Drawn all{spectrum_of(joint, left, ratio), spectrum_of(joint, before, ratio), law.names()};
  auto notes = error_notes(results);
  notes.push_back(fmt::format(
      "Share of the squared deviations of {}, weighted by how well each pose shows the joint, that "
      "one wave with free phase explains; fitted and held-out poses together, n = {}{}.",
      joint.name, all.left.points,
      all.left.points < static_cast<int>(joint.poses.size())
          ? fmt::format(", an even choice of {}", joint.poses.size())
          : ""));
  if (ratio > 0.0)
    notes.push_back(fmt::format("Gear ratio {:g}: the motor turns {:g} times {}.", ratio, ratio,
                                per_words(joint)));
  else
    notes.push_back(
        fmt::format("The gear ratio of {} is not known: gear_ratio in cell.toml would "
                    "mark where once and twice a turn of its motor lie.",
                    joint.name));
  if (!law.empty()) notes.push_back("Fitted law of this joint: " + all.law + ".");
  std::vector<draw::LegendEntry> legend{
      {.words = "what the model leaves", .line = draw::LineStyle{Tone::kBlue, 1.6}}};
  if (!law.empty())
    legend.push_back({.words = "without the law fitted to this joint",
                      .line = draw::LineStyle{Tone::kVermilion, 1.2}});
  double most = 1.0;
  for (const auto* of : {&all.left, &all.before})
    for (const double share : of->share) most = std::max(most, 115.0 * share);
  if (!all.left.cycles.empty()) most = std::max(most, 115.0 * std::min(1.0, all.left.chance));
  draw::Sheet sheet(width, {.title = fmt::format("Waves in the deviation of {}", joint.name),
                            .sentence = spectrum_sentence(joint, all),
                            .legend = std::move(legend),
                            .notes = std::move(notes)});
  const bool none = all.left.cycles.empty();
  draw::Panel panel(
      sheet.svg(), sheet.room(370.0),
      {.title = joint.turns ? "cycles a turn of the joint" : "cycles a metre",
       .low = none ? 1.0 : all.left.cycles.front(),
       .high = none ? 100.0 : all.left.cycles.back(),
       .scale = draw::Axis::Scale::kLog,
       .ends = draw::Axis::Ends::kExact},
      {.title = "share of the squared deviations [%]", .low = 0.0, .high = std::min(most, 100.0)});
  if (none) return sheet.file();
  draw_line(all.before, {.paint = Tone::kVermilion, .width = 1.2}, panel);
  draw_line(all.left, {.paint = Tone::kBlue, .width = 1.6}, panel);
  name_peaks(all.before, Tone::kVermilion, panel);
  name_peaks(all.left, Tone::kBlue, panel);
  panel.levels_y({{.at = 100.0 * all.left.chance,
                   .words = "chance, once in 100 spectra",
                   .style = {.paint = Tone::kGreen, .width = 1.2, .dashes = "2 2"}}});
  const draw::LineStyle motor{.paint = Tone::kPurple, .width = 1.2, .dashes = "6 3"};
  if (ratio > 0.0)
    panel.levels_x({{.at = ratio, .words = "motor", .style = motor},
                    {.at = 2.0 * ratio, .words = "2 x motor", .style = motor}});
  return sheet.file();
}

}  // namespace plumb::offline::figures
