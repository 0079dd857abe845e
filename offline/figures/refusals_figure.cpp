// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "cell/random.hpp"
#include "compile/compiler.hpp"
#include "figures/model_figures.hpp"
#include "figures/words.hpp"
#include "figures/workspace_views.hpp"
#include "plumb/runtime/corrector.hpp"

namespace plumb::offline::figures {
namespace {

using draw::Mark;
using draw::Shape;
using draw::Tone;

constexpr int kPoses = 1500;
constexpr int kMostDrawn = 600;  // in each view
constexpr int kBands = 12;       // of a joint range
/// A band of a joint is named if it has so many poses and so many times the mean share of refusals.
constexpr double kFewestInRefusalBand = 20.0, kWellAbove = 1.5;
constexpr double kSignMargin_px = 10.0;

/// What happens at a pose, the gravest first.
enum Fate { kSingular, kConfiguration, kFar, kLimit, kGuard, kOutside, kCorrected, kFates };

struct FateSign {
  const char* words;
  Shape shape;
  Tone tone;
};
constexpr std::array<FateSign, kFates> kSigns{
    {{"refused: near a singular pose", Shape::kCross, Tone::kVermilion},
     {"refused: other configuration", Shape::kDiamond, Tone::kPurple},
     {"refused: far from the seed, or not converged", Shape::kTriangle, Tone::kInk},
     {"beyond a joint limit", Shape::kSquare, Tone::kOrange},
     {"cut by the guard", Shape::kTriangle, Tone::kGreen},
     {"outside what was measured: fades out", Shape::kCircle, Tone::kBlue},
     {"corrected", Shape::kCircle, Tone::kMuted}}};

struct Tried {
  std::vector<double> q;
  Eigen::Vector3d p_B;
  Fate fate = kCorrected;
};

Fate fate_of(const format::Model& model, const Correction& found, const Transformd& X_BD) {
  switch (found.status) {
    case Status::kNearSingular:
      return kSingular;
    case Status::kOtherConfiguration:
      return kConfiguration;
    default:
      if (refused(found.status)) return kFar;
  }
  for (std::size_t j = 0; j < model.nominal.joints.size(); ++j) {
    const auto& row = model.nominal.joints[j];
    if (found.q[j] < row.q_min || found.q[j] > row.q_max) return kLimit;
  }
  if ((found.X_BC.p - X_BD.p).norm() > model.guard.max_correction_m ||
      rotation_vector(found.X_BC.R * X_BD.R.transpose()).norm() > model.guard.max_rotation_rad)
    return kGuard;
  return found.status == Status::kOutsideDomain ? kOutside : kCorrected;
}

std::vector<Tried> tried_poses(const format::Model& model) {
  const Corrector corrector(model);
  const Chain& nominal = corrector.nominal();
  Random random(1);
  std::vector<Tried> out;
  for (int i = 0; i < kPoses; ++i) {
    Tried one;
    for (const auto& row : model.nominal.joints)
      one.q.push_back(row.q_min + random.unit() * (row.q_max - row.q_min));
    const Transformd X_BD = nominal.forward(one.q);
    one.p_B = {X_BD.p(0), X_BD.p(1), X_BD.p(2)};
    one.fate = fate_of(model, corrector.solve(X_BD, one.q, SeedKind::kCommanded), X_BD);
    out.push_back(std::move(one));
  }
  return out;
}

std::array<int, kFates> counts_of(const std::vector<Tried>& all) {
  std::array<int, kFates> out{};
  for (const Tried& one : all) ++out[static_cast<std::size_t>(one.fate)];
  return out;
}

double percent(int n) { return 100.0 * n / kPoses; }

bool is_refused(const Tried& one) { return one.fate < kLimit; }

/// "most of all at J3 between -30 and 30 deg (62 %)": the band of a joint in which the share of
/// refusals is largest, if that is well above the mean.
std::string worst_band_words(const std::vector<Tried>& all, const format::Chain& nominal) {
  double mean = 0.0, most = 0.0;
  for (const Tried& one : all) mean += is_refused(one) / static_cast<double>(all.size());
  std::string out;
  for (std::size_t j = 0; j < nominal.joints.size(); ++j) {
    const auto& row = nominal.joints[j];
    const bool slides = row.type == format::JointType::kPrismatic;
    const double step = (row.q_max - row.q_min) / kBands;
    const double per = slides ? 1e3 : 180.0 / std::numbers::pi;
    for (int k = 0; k < kBands && step > 0.0; ++k) {
      double n = 0.0, refusals = 0.0;
      for (const Tried& one : all) {
        if (one.q[j] < row.q_min + k * step || one.q[j] >= row.q_min + (k + 1) * step) continue;
        n += 1.0, refusals += is_refused(one);
      }
      if (n < kFewestInRefusalBand || refusals / n < std::max(most, kWellAbove * mean)) continue;
      most = refusals / n;
      out = fmt::format(", most of all at {} between {:.0f} and {:.0f} {} ({:.0f} %)", row.name,
                        std::round(per * (row.q_min + k * step)) + 0.0,
                        std::round(per * (row.q_min + (k + 1) * step)) + 0.0, slides ? "mm" : "deg",
                        100.0 * most);
    }
  }
  return out;
}

std::string refusal_sentence(const std::array<int, kFates>& n, const std::string& where) {
  const int refusals = n[kSingular] + n[kConfiguration] + n[kFar];
  std::string out =
      refusals == 0
          ? std::string("The inverse refuses none of the poses within the joint limits")
          : fmt::format(
                "The inverse refuses {:.1f} % of the poses within the joint limits, mostly "
                "{}",
                percent(refusals),
                n[kSingular] >= std::max(n[kConfiguration], n[kFar]) ? "near singular poses"
                : n[kConfiguration] >= n[kFar]
                    ? "because the solution lies in another configuration"
                    : "because the solution is far from the seed") +
                where;
  std::vector<std::string> more;
  if (n[kLimit] > 0)
    more.push_back(fmt::format("{:.1f} % would pass a joint limit", percent(n[kLimit])));
  if (n[kGuard] > 0)
    more.push_back(fmt::format("{:.1f} % are cut by the guard", percent(n[kGuard])));
  if (n[kOutside] > 0)
    more.push_back(fmt::format("{:.{}f} % lie outside what was measured", percent(n[kOutside]),
                               percent(n[kOutside]) < 10.0 ? 1 : 0));
  for (std::size_t i = 0; i < more.size(); ++i)
    out += (i == 0 ? "; " : i + 1 == more.size() ? " and " : ", ") + more[i];
  return out + ".";
}

void draw_joint_bands(const std::vector<Tried>& all, const format::JointRow& row, std::size_t j,
                      draw::Panel& panel) {
  std::vector<std::array<int, kFates>> bands(kBands);
  for (const Tried& one : all) {
    const double share = (one.q[j] - row.q_min) / std::max(1e-12, row.q_max - row.q_min);
    const auto band = static_cast<std::size_t>(std::clamp(share * kBands, 0.0, kBands - 1.0));
    ++bands[band][static_cast<std::size_t>(one.fate)];
  }
  const double step = (panel.x_high() - panel.x_low()) / kBands;
  for (int k = 0; k < kBands; ++k) {
    const auto& band = bands[static_cast<std::size_t>(k)];
    int sum = 0;
    for (const int n : band) sum += n;
    double low = 0.0;
    for (std::size_t fate = 0; fate < kCorrected && sum > 0; ++fate) {
      const double high = low + 100.0 * band[fate] / sum;
      const double left = panel.x_low() + step * k;
      if (band[fate] > 0)
        panel.bar(left, low, left + step, high, kSigns[fate].tone,
                  {.paint = Tone::kPaper, .width = 0.5},
                  fmt::format("{}: {} of {}", kSigns[fate].words, band[fate], sum));
      low = high;
    }
  }
}

}  // namespace

std::string refusals_figure(const RunResults& results, double width) {
  const format::Model model = compile(results.cell, results.run);
  const auto all = tried_poses(model);
  const auto n = counts_of(all);
  std::vector<draw::LegendEntry> legend;
  for (std::size_t fate = 0; fate < kFates; ++fate)
    if (n[fate] > 0)
      legend.push_back({.words = fmt::format("{} ({})", kSigns[fate].words, n[fate]),
                        .mark = Mark{kSigns[fate].shape, kSigns[fate].tone}});
  Extent extent;
  for (const Tried& one : all) extent.add(one.p_B);
  const WorkspaceViews views(width, extent, kSignMargin_px);
  draw::Sheet sheet(
      width,
      {.title = "Where the arm cannot be corrected, and why",
       .sentence = refusal_sentence(n, worst_band_words(all, model.nominal)),
       .legend = std::move(legend),
       .notes = {fmt::format(
           "Run {}, through the controller's own inverse correction: {} random poses within the "
           "joint limits, each with its own joints as seed; n in brackets. In each view {} of them "
           "are drawn. Bars: share of the poses in a band of the joint. Limits of the guard: {} "
           "and "
           "{:.2g} mrad.",
           results.run.number, kPoses, kMostDrawn, length_text(model.guard.max_correction_m),
           1e3 * model.guard.max_rotation_rad)}});
  auto panels = views.panels(sheet);
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const View& view = views.views()[k];
    sheet.svg().clip(panels[k].plot());
    // What matters most is drawn last, over the rest.
    for (int fate = kFates - 1; fate >= 0; --fate) {
      std::vector<draw::Point> at;
      for (int i = 0; i < kMostDrawn; ++i) {
        const Tried& one = all[static_cast<std::size_t>(i)];
        if (one.fate == fate)
          at.push_back(panels[k].at(1e3 * one.p_B(view.across), 1e3 * one.p_B(view.up)));
      }
      const FateSign& sign = kSigns[static_cast<std::size_t>(fate)];
      sheet.svg().marks(at, {.shape = sign.shape,
                             .paint = sign.tone,
                             .size = fate == kCorrected ? 1.0
                                     : fate == kOutside ? 1.6
                                                        : 3.0,
                             .words = sign.words});
    }
    sheet.svg().end_clip();
  }
  const auto rooms = sheet.grid(static_cast<int>(model.nominal.joints.size()), 200.0, 150.0);
  for (std::size_t j = 0; j < rooms.size(); ++j) {
    const auto& row = model.nominal.joints[j];
    const bool slides = row.type == format::JointType::kPrismatic;
    const double per = slides ? 1e3 : 180.0 / std::numbers::pi;
    draw::Panel panel(sheet.svg(), rooms[j],
                      {.title = slides ? "position [mm]" : "position [deg]",
                       .low = per * row.q_min,
                       .high = per * row.q_max,
                       .ends = draw::Axis::Ends::kExact},
                      {.title = "share [%]", .low = 0.0, .high = 100.0}, row.name);
    draw_joint_bands(all, row, j, panel);
  }
  return sheet.file();
}

}  // namespace plumb::offline::figures
