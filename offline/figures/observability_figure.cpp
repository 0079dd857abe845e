// SPDX-License-Identifier: Apache-2.0
#include "figures/observability_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "draw/panel.hpp"
#include "draw/sheet.hpp"
#include "figures/words.hpp"
#include "plan/information.hpp"
#include "plan/plan_steps.hpp"

namespace plumb::offline::figures {
namespace {

using draw::Tone;

constexpr int kPool = 800, kJudged = 200;
constexpr std::uint64_t kPlanSeed = 1, kRandomSeed = 77, kJudgedSeed = 78;

/// The readings of these poses one after the other, the most telling first or as they come.
enum class Order { kByWorth, kAsTheyCome };
std::vector<PoseGain> gains_of(const DesignSpace& space, Information information,
                               const Measurements& check, const Measurements& poses,
                               const std::vector<std::string>& names, Order order) {
  auto left = blocks(space.lines(poses), space.per_pose());
  auto left_names = names;
  std::vector<PoseGain> out;
  while (!left.empty()) {
    std::size_t best = 0;
    double most = information.gain(left[0]);
    for (std::size_t k = 1; order == Order::kByWorth && k < left.size(); ++k)
      if (const double gain = information.gain(left[k]); gain > most) most = gain, best = k;
    information.add(left[best]);
    out.push_back(
        {left_names[best], most, prediction_sigma(space, check, information.covariance()).mean});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
    left_names.erase(left_names.begin() + static_cast<std::ptrdiff_t>(best));
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
      "{} to {}; the first {} bring half of that",
      growth.planned.size(), length_text(growth.sigma_now_m), length_text(last), half + 1);
  if (!growth.random.empty())
    out += fmt::format(", and as many random poses would reach {}",
                       length_text(growth.random.back().sigma_m));
  return out + ".";
}

}  // namespace

InformationGrowth information_growth(const RunResults& results, int n) {
  const Cell& cell = results.cell;
  PlanRequest request{.n = n, .rules = {.pool = kPool, .seed = kPlanSeed}};
  const PosePlan plan = plan_poses(cell, results.measured, request);
  InformationGrowth out;
  out.measured = plan.measured, out.numbers = plan.parameters, out.remarks = plan.remarks;
  const ArmState& state = results.run.fit.calibration.state;
  const auto some = [&](int count, std::uint64_t seed) {
    return imagined(cell, results.measured, pose_pool(cell, state, {.pool = count, .seed = seed}),
                    seed);
  };
  const Measurements check = some(kJudged, kJudgedSeed), random = some(n, kRandomSeed);
  const DesignSpace space = design_space(cell, state, check, plan.sigma_m, 0.0);
  std::vector<int> used = results.held;
  used.insert(used.end(), results.fit.begin(), results.fit.end());
  std::sort(used.begin(), used.end());
  Information known(space.prior());
  if (!used.empty()) known.add(space.lines(pick(results.measured, used)));
  out.sigma_now_m = prediction_sigma(space, check, known.covariance()).mean;
  RowsN q(static_cast<Eigen::Index>(plan.poses.size()), cell.joints());
  std::vector<std::string> names, numbers;
  for (const PlannedPose& pose : plan.poses) {
    q.row(static_cast<Eigen::Index>(names.size())) = pose.q.transpose();
    names.push_back(pose.name);
  }
  for (int k = 0; k < random.size(); ++k) numbers.push_back(fmt::format("random {}", k + 1));
  out.planned = gains_of(space, known, check, imagined(cell, results.measured, q, kPlanSeed), names,
                         Order::kByWorth);
  out.random = gains_of(space, known, check, random, numbers, Order::kAsTheyCome);
  return out;
}

std::string observability_figure(const InformationGrowth& growth, int run, double width) {
  std::vector<std::string> notes{fmt::format(
      "Run {}: {} numbers, {} poses measured. 1 sigma of the reflector, three axes together, is "
      "the "
      "mean over {} other random poses, if the model is right. Gain: rise of ln det of the "
      "information by one pose, given those before; 2 nats narrow one combination of the numbers "
      "to "
      "about a seventh in variance. plumb plan writes such a plan.",
      run, growth.numbers, growth.measured, kJudged)};
  const draw::Mark mark{.shape = draw::Shape::kCircle, .paint = Tone::kBlue};
  draw::Sheet sheet(
      width,
      {.title = "What the next poses would tell",
       .sentence = growth_sentence(growth),
       .legend = {{.words = "planned, the most telling first", .mark = mark},
                  {.words = "random poses", .line = draw::LineStyle{Tone::kMuted, 1.6, "6 3"}}},
       .notes = std::move(notes)});
  double most_m = growth.sigma_now_m, most_nats = 1e-3;
  for (const PoseGain& gain : growth.planned) most_nats = std::max(most_nats, gain.nats);
  const LengthUnit unit = unit_for(most_m);
  const double n = static_cast<double>(growth.planned.size() + 1);
  draw::Panel above(sheet.svg(), sheet.room(250.0),
                    {.title = "", .low = 0.0, .high = n, .ends = draw::Axis::Ends::kExact},
                    {.title = fmt::format("mean 1 sigma of the predicted point [{}]", unit.name),
                     .low = 0.0,
                     .high = unit.per_m * most_m});
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
