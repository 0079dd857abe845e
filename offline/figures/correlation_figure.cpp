// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "draw/panel.hpp"
#include "draw/sheet.hpp"
#include "figures/data_figures.hpp"
#include "figures/words.hpp"

namespace plumb::offline::figures {
namespace {

using draw::Tone;

constexpr Eigen::Index kMostNumbers = 60;
constexpr double kStrong = 0.9;  // correlation beyond which two numbers can hardly be told apart
constexpr double kFaint = 0.05;  // below it a cell is left empty

Eigen::MatrixXd correlation_of(const Eigen::MatrixXd& covariance) {
  Eigen::MatrixXd out = covariance;
  for (Eigen::Index i = 0; i < out.rows(); ++i)
    for (Eigen::Index j = 0; j < out.cols(); ++j) {
      const double both = std::sqrt(covariance(i, i) * covariance(j, j));
      out(i, j) = both > 0.0 ? std::clamp(covariance(i, j) / both, -1.0, 1.0) : 0.0;
    }
  return out;
}

/// Each number after the one that it moves with most, beginning with the most correlated pair.
std::vector<Eigen::Index> chained(const Eigen::MatrixXd& r) {
  std::vector<Eigen::Index> out;
  std::vector<bool> taken(static_cast<std::size_t>(r.rows()), false);
  const auto take = [&](Eigen::Index i) {
    out.push_back(i);
    taken[static_cast<std::size_t>(i)] = true;
  };
  while (static_cast<Eigen::Index>(out.size()) < r.rows()) {
    Eigen::Index best = -1;
    double most = -1.0;
    for (Eigen::Index i = 0; i < r.rows(); ++i) {
      if (taken[static_cast<std::size_t>(i)]) continue;
      double size = 0.0;
      if (!out.empty())
        size = std::abs(r(out.back(), i));
      else
        for (Eigen::Index j = 0; j < r.rows(); ++j)
          if (j != i) size = std::max(size, std::abs(r(i, j)));
      if (size > most) most = size, best = i;
    }
    take(best);
  }
  return out;
}

struct Pair {
  Eigen::Index a = 0, b = 0;
  double r = 0.0;
};

std::vector<Pair> strong_pairs(const Eigen::MatrixXd& r) {
  std::vector<Pair> out;
  for (Eigen::Index i = 0; i < r.rows(); ++i)
    for (Eigen::Index j = 0; j < i; ++j)
      if (std::abs(r(i, j)) >= kStrong) out.push_back({j, i, r(i, j)});
  std::stable_sort(out.begin(), out.end(),
                   [](const Pair& a, const Pair& b) { return std::abs(a.r) > std::abs(b.r); });
  return out;
}

}  // namespace

std::string correlation_figure(const RunResults& results, double width) {
  const Calibration& c = results.run.fit.calibration;
  const auto all =
      std::min<Eigen::Index>(c.covariance.rows(), static_cast<Eigen::Index>(c.estimates.size()));
  const Eigen::MatrixXd r = correlation_of(c.covariance.topLeftCorner(all, all));
  const auto name = [&](Eigen::Index i) { return c.estimates[static_cast<std::size_t>(i)].name; };
  const auto strong = strong_pairs(r);
  std::string sentence =
      "No two fitted numbers move together so much that they could not be told apart.";
  if (all == 0) sentence = "This run fitted no numbers, or does not know their covariance.";
  if (!strong.empty())
    sentence = fmt::format(
        "{} {} can hardly be told apart; the closest are {} and {} (correlation "
        "{:.3f}).",
        strong.size(), strong.size() == 1 ? "pair of numbers" : "pairs of numbers",
        name(strong.front().a), name(strong.front().b), strong.front().r);
  auto order = chained(r);
  std::vector<std::string> notes{fmt::format(
      "Run {}: {} fitted numbers, tracker frame and reflector included. Numbers that move together "
      "stand together; strong means at least {:g} either way. Cells below {:g} are empty.",
      results.run.number, all, kStrong, kFaint)};
  if (all > kMostNumbers) {
    order.resize(kMostNumbers);
    notes.push_back(
        fmt::format("{} of {} numbers are shown, those most correlated first.", kMostNumbers, all));
  }
  draw::Sheet sheet(width, {.title = "Which fitted numbers can be told apart",
                            .sentence = sentence,
                            .legend = {{.words = "-1", .area = draw::signed_colour(-1.0)},
                                       {.words = "0", .area = draw::signed_colour(0.0)},
                                       {.words = "+1", .area = draw::signed_colour(1.0)}},
                            .notes = std::move(notes)});
  const auto n = static_cast<double>(std::max<std::size_t>(1, order.size()));
  std::vector<draw::Tick> ticks{{-1.0, ""}};
  for (std::size_t i = 0; i < order.size(); ++i)
    ticks.push_back({n - 0.5 - static_cast<double>(i), name(order[i])});
  const double side = std::min(sheet.svg().width() - 28.0, 60.0 + std::max(140.0, 15.0 * n));
  draw::Box room = sheet.room(std::max(side, 40.0 + 14.0 * n));
  room.right = std::min(room.right, room.left + 150.0 + 24.0 * n);
  draw::Panel panel(sheet.svg(), room, {.low = 0.0, .high = n, .ticks = {{-1.0, ""}}},
                    {.low = 0.0, .high = n, .ticks = ticks});
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      const double value = r(order[i], order[j]);
      if (std::abs(value) < kFaint) continue;
      const double x = static_cast<double>(j), y = n - 1.0 - static_cast<double>(i);
      panel.bar(x, y, x + 1.0, y + 1.0, draw::signed_colour(value), {.paint = {}},
                fmt::format("{} and {}: {:.2f}", name(order[i]), name(order[j]), value));
    }
  return sheet.file();
}

}  // namespace plumb::offline::figures
