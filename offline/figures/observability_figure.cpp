// SPDX-License-Identifier: Apache-2.0
#include "figures/observability_figure.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "draw/panel.hpp"
#include "draw/sheet.hpp"
#include "figures/words.hpp"
#include "noise/weights.hpp"
#include "numbers/cholesky.hpp"
#include "plan/design_space.hpp"
#include "plan/information.hpp"
#include "plan/plan_steps.hpp"
#include "plan/pose_pool.hpp"
#include "program/counted_words.hpp"

namespace plumb::offline::figures {
namespace {

using draw::Tone;

constexpr double kLogFall = 10.0;          // from the first to the last sigma: a logarithmic axis
constexpr int kPool = 800, kJudged = 200;  // random poses to choose from, and to judge by
constexpr std::uint64_t kPoolSeed = 1, kRandomSeed = 77, kJudgedSeed = 78;

/// G = A M^-1 A^T of some poses, A the whitened derivatives of one. Kept up to date while readings
/// are added: those costs do not grow with the number of parameters squared.
class Gains {
 public:
  Gains(std::vector<Eigen::MatrixXd> lines, const Eigen::MatrixXd& covariance)
      : lines_(std::move(lines)) {
    for (const auto& A : lines_) known_.emplace_back(A * covariance * A.transpose());
  }

  std::size_t size() const { return lines_.size(); }
  const Eigen::MatrixXd& lines(std::size_t pose) const { return lines_[pose]; }

  /// ln det(I + G).
  double nats(std::size_t pose) const {
    Small grown = known_[pose];
    grown.diagonal().array() += 1.0;
    const Eigen::LLT<Small> root(grown);
    double out = 0.0;
    for (Eigen::Index i = 0; i < grown.rows(); ++i) out += 2.0 * std::log(root.matrixLLT()(i, i));
    return out;
  }

  /// Mean 1 sigma of the points, in those of one axis of a reading.
  double mean_sigma() const {
    double out = 0.0;
    for (const auto& G : known_)
      out += std::sqrt(std::max(0.0, G.trace())) / static_cast<double>(known_.size());
    return out;
  }

  /// M^-1 fell by half^T half.
  void add(const Eigen::MatrixXd& half) {
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      const Small fallen = lines_[i].lazyProduct(half.transpose());
      known_[i] -= fallen.lazyProduct(fallen.transpose());
    }
  }

 private:
  /// A square of the axes of one reading, at most 6, which needs no heap: allocations would take
  /// most of the time.
  using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;

  std::vector<Eigen::MatrixXd> lines_;
  std::vector<Small> known_;
};

/// `n` readings one after the other, the most telling first or as they come; after each, how sure
/// the judged points are.
enum class Order { kByWorth, kAsTheyCome };
std::vector<PoseGain> gains_of(Gains poses, Gains judged, Eigen::MatrixXd covariance, int n,
                               double sigma_m, Order order) {
  std::vector<PoseGain> out;
  std::vector<bool> taken(poses.size(), false);
  const std::size_t most = std::min(static_cast<std::size_t>(n), poses.size());
  while (out.size() < most) {
    std::size_t best = out.size();
    if (order == Order::kByWorth) {
      double nats = -INFINITY;
      for (std::size_t k = 0; k < poses.size(); ++k)
        if (const double gain = taken[k] ? -INFINITY : poses.nats(k); gain > nats)
          nats = gain, best = k;
    }
    taken[best] = true;
    const Eigen::MatrixXd& A = poses.lines(best);
    Eigen::MatrixXd grown = A * covariance * A.transpose();
    grown.diagonal().array() += 1.0;
    const Eigen::MatrixXd half = Cholesky(grown).whitened(A * covariance);
    const double nats = poses.nats(best);
    covariance.noalias() -= half.transpose() * half;
    poses.add(half);
    judged.add(half);
    out.push_back({fmt::format("pose {} of {}", best + 1, poses.size()), nats,
                   sigma_m * judged.mean_sigma()});
  }
  return out;
}

std::string growth_sentence(const InformationGrowth& growth) {
  if (growth.planned.empty()) return "No further pose could be planned.";
  const double last = growth.planned.back().sigma_m, fall = growth.sigma_now_m - last;
  std::size_t half = 0;
  while (half + 1 < growth.planned.size() &&
         growth.sigma_now_m - growth.planned[half].sigma_m < 0.5 * fall)
    ++half;
  std::string out = fmt::format(
      "{} planned poses would take the predicted 1 sigma of the point from "
      "{} to {}; {} half of that",
      growth.planned.size(), length_text(growth.sigma_now_m), length_text(last),
      half == 0 ? "the first one brings" : fmt::format("the first {} bring", half + 1));
  if (!growth.random.empty())
    out += fmt::format(", and as many random poses would reach {}",
                       length_text(growth.random.back().sigma_m));
  return out + ".";
}

}  // namespace

InformationGrowth information_growth(const RunResults& results, int n) {
  const Cell& cell = results.cell;
  const ArmState& state = results.run.fit.calibration.state;
  std::vector<int> used = results.held;
  used.insert(used.end(), results.fit.begin(), results.fit.end());
  std::sort(used.begin(), used.end());
  const Measurements measured = pick(results.measured, used);
  const double sigma_m = reading_sigma(cell, measured);
  const auto some = [&](int count, std::uint64_t seed) {
    return imagined(cell, results.measured, pose_pool(cell, state, {.pool = count, .seed = seed}),
                    seed);
  };
  const Measurements judged = some(kJudged, kJudgedSeed);
  const DesignSpace space = design_space(cell, state, judged, sigma_m, 0.0);
  Information known(space.prior());
  if (!used.empty()) known.add(space.lines(measured));
  const auto gains = [&](const Measurements& at) {
    return Gains(blocks(space.lines(at), space.per_pose()), known.covariance());
  };
  const Gains points = gains(judged);
  InformationGrowth out{.sigma_now_m = sigma_m * points.mean_sigma(),
                        .numbers = static_cast<int>(space.size()),
                        .measured = static_cast<int>(used.size())};
  out.planned = gains_of(gains(some(kPool, kPoolSeed)), points, known.covariance(), n, sigma_m,
                         Order::kByWorth);
  out.random = gains_of(gains(some(n, kRandomSeed)), points, known.covariance(), n, sigma_m,
                        Order::kAsTheyCome);
  return out;
}

std::string observability_figure(const InformationGrowth& growth, int run, double width) {
  std::vector<std::string> notes{fmt::format(
      "Run {}: {}, {}. 1 sigma of the reflector, all measured axes "
      "together, "
      "is the mean over {} other random poses, if the model is right. Gain: rise of ln det of the "
      "information by one pose, given those before; 2 nats narrow one combination of the numbers "
      "to about a seventh in variance. Each pose is the most telling of {} random ones; plumb plan "
      "chooses from more, improves the choice and writes it.",
      run, counted_words(growth.numbers, "number", "numbers"),
      counted_words(growth.measured, "pose measured", "poses measured"), kJudged, kPool)};
  const draw::Mark mark{.shape = draw::Shape::kCircle, .paint = Tone::kBlue};
  draw::Sheet sheet(
      width,
      {.title = "What the next poses would tell",
       .sentence = growth_sentence(growth),
       .legend = {{.words = "planned, the most telling first", .mark = mark},
                  {.words = "random poses", .line = draw::LineStyle{Tone::kMuted, 1.6, "6 3"}}},
       .notes = std::move(notes)});
  double most_m = growth.sigma_now_m, least_m = most_m, most_nats = 1e-3;
  for (const auto* gains : {&growth.planned, &growth.random})
    for (const PoseGain& gain : *gains) least_m = std::min(least_m, gain.sigma_m);
  const bool log = least_m > 0.0 && most_m > kLogFall * least_m;
  for (const PoseGain& gain : growth.planned) most_nats = std::max(most_nats, gain.nats);
  const LengthUnit unit = unit_for(most_m);
  const double n = static_cast<double>(growth.planned.size() + 1);
  draw::Panel above(sheet.svg(), sheet.room(250.0),
                    {.title = "", .low = 0.0, .high = n, .ends = draw::Axis::Ends::kExact},
                    {.title = fmt::format("mean 1 sigma of the predicted point [{}]", unit.name),
                     .low = log ? unit.per_m * least_m : 0.0,
                     .high = unit.per_m * most_m,
                     .scale = log ? draw::Axis::Scale::kLog : draw::Axis::Scale::kLinear});
  std::vector<draw::Point> random{{0.0, unit.per_m * growth.sigma_now_m}}, planned = random;
  for (std::size_t k = 0; k < growth.random.size(); ++k)
    random.push_back({static_cast<double>(k + 1), unit.per_m * growth.random[k].sigma_m});
  for (std::size_t k = 0; k < growth.planned.size(); ++k)
    planned.push_back({static_cast<double>(k + 1), unit.per_m * growth.planned[k].sigma_m});
  above.line(random, {.paint = Tone::kMuted, .width = 1.6, .dashes = "6 3"});
  above.line(planned, {.paint = Tone::kBlue, .width = 1.6});
  draw::Panel below(
      sheet.svg(), sheet.room(190.0),
      {.title = "poses measured next", .low = 0.0, .high = n, .ends = draw::Axis::Ends::kExact},
      {.title = "gain of each [nats]", .low = 0.0, .high = most_nats});
  for (std::size_t k = 0; k < growth.planned.size(); ++k) {
    const PoseGain& gain = growth.planned[k];
    draw::Mark here = mark;
    here.pose = gain.pose;
    here.words = fmt::format("{}: {} nats, then 1 sigma {}", gain.pose, draw::digits(gain.nats, 2),
                             length_text(gain.sigma_m));
    above.mark(planned[k + 1].x, planned[k + 1].y, here);
    below.bar(static_cast<double>(k) + 0.6, 0.0, static_cast<double>(k) + 1.4, gain.nats,
              Tone::kBlue, {.paint = Tone::kPaper, .width = 0.5}, here.words);
  }
  return sheet.file();
}

}  // namespace plumb::offline::figures
