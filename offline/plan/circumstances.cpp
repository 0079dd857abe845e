// SPDX-License-Identifier: Apache-2.0
#include "plan/circumstances.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "effects/registry.hpp"

namespace plumb::offline {
namespace {

constexpr unsigned kNeedsArrival = kNeedsDirection | kNeedsTravel | kNeedsSteps;
constexpr unsigned kNeedsLater = kNeedsTime | kNeedsOrder;
/// A usual last move of a joint [rad], or [m] of one that slides, and how much shorter or longer
/// the moves are that are offered.
constexpr double kUsualMove = 10.0 * std::numbers::pi / 180.0;
constexpr std::array kMoveLengths = {0.2, 1.0, 3.0};
/// Measured poses that are offered once more.
constexpr int kMostAgain = 40;

/// Lightest and heaviest load of the readings, if they differ.
std::vector<Payload> loads_measured(const Cell& cell, const Measurements& measured) {
  std::vector<Payload> out;
  for (Eigen::Index i = 0; i < measured.context.payload.rows(); ++i) {
    const auto row = measured.context.payload.row(i);
    if (std::isnan(row(0))) continue;
    Payload load{row(0), cell.payload.com_m};
    for (int k = 0; k < 3; ++k)
      if (!std::isnan(row(1 + k))) load.com_m[static_cast<std::size_t>(k)] = row(1 + k);
    out.push_back(load);
  }
  const auto lighter = [](const Payload& a, const Payload& b) { return a.mass_kg < b.mass_kg; };
  if (out.empty()) return out;
  const auto [least, most] = std::minmax_element(out.begin(), out.end(), lighter);
  if (!(most->mass_kg > least->mass_kg)) return {};
  return {*least, *most};
}

std::vector<Payload> loads_of(const Cell& cell, const Measurements& measured,
                              const std::vector<double>& given_kg) {
  std::vector<Payload> out;
  for (const double kg : given_kg) out.push_back({kg, cell.payload.com_m});
  if (out.empty()) out = loads_measured(cell, measured);
  if (out.empty() && cell.payload.mass_kg > 0.0) out = {{0.0, cell.payload.com_m}, cell.payload};
  return out;
}

/// The last move of every joint: to one side or the other, and back within the limits.
Eigen::VectorXd random_approach(const Cell& cell, const Circumstances& circumstances,
                                const Eigen::VectorXd& q, Random& random) {
  Eigen::VectorXd out(q.size());
  for (Eigen::Index j = 0; j < q.size(); ++j) {
    const auto& row = cell.nominal.joints[static_cast<std::size_t>(j)];
    const auto which = static_cast<std::size_t>(random.unit() * kMoveLengths.size());
    double move = kUsualMove;
    if (circumstances.short_and_long)
      move *= kMoveLengths[std::min(which, kMoveLengths.size() - 1)];
    const double range = row.q_max - row.q_min;
    if (range > 0.0) move = std::min(move, 0.4 * range);
    if (random.unit() < 0.5) move = -move;
    const double from = q(j) - move;
    if (range > 0.0 && (from < row.q_min || from > row.q_max)) move = -move;
    out(j) = move;
  }
  return out;
}

/// Rows 0 .. n - 1 of a table that may be missing, then `more` rows; NaN becomes `otherwise`.
RowsN joined(const RowsN& first, Eigen::Index n, const RowsN& more, const RowsN& otherwise) {
  RowsN out(n + more.rows(), more.cols());
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < more.cols(); ++k) {
      const bool known = first.rows() > 0 && k < first.cols() && !std::isnan(first(i, k));
      out(i, k) = known ? first(i, k) : otherwise(0, k);
    }
  out.bottomRows(more.rows()) = more;
  return out;
}

RowsN row_of(const Payload& load) {
  RowsN out(1, 4);
  out << load.mass_kg, load.com_m[0], load.com_m[1], load.com_m[2];
  return out;
}

}  // namespace

std::vector<Contrast> Circumstances::contrasts() const {
  std::vector<Contrast> out;
  if (short_and_long) out.push_back(Contrast::kShortAndLong);
  if (approach && !short_and_long) out.push_back(Contrast::kBothSides);
  if (warm) out.push_back(Contrast::kColdAndWarm);
  if (late) out.push_back(Contrast::kEndAgain);
  if (two_payloads()) out.push_back(Contrast::kTwoPayloads);
  return out;
}

Circumstances circumstances_of(const Cell& cell, const Measurements& measured, const EffectEntry& a,
                               const EffectEntry& b, const std::vector<double>& given_kg) {
  const EffectDescriptor &first = descriptor_of(a.name), &second = descriptor_of(b.name);
  const unsigned either = first.law->needs | second.law->needs;
  const unsigned only = first.law->needs ^ second.law->needs;
  Circumstances out;
  out.approach = (either & kNeedsArrival) != 0;
  out.short_and_long = (either & kNeedsSteps) != 0;
  out.warm = (only & kNeedsTemperature) != 0;
  out.late = (only & kNeedsLater) != 0;
  out.load_matters = grows_with_load(first) || grows_with_load(second);
  if (out.load_matters) out.payloads = loads_of(cell, measured, given_kg);
  return out;
}

ReadingOption option_at(const Cell& cell, const Circumstances& circumstances,
                        const Eigen::VectorXd& q, const ReadingOption& like, Random& random) {
  ReadingOption out = like;
  out.q = q;
  out.again = -1;
  if (circumstances.approach) out.approach = random_approach(cell, circumstances, q, random);
  return out;
}

std::vector<ReadingOption> reading_options(const Cell& cell, const Measurements& measured,
                                           const RowsN& pool, const Circumstances& circumstances,
                                           int most, std::uint64_t seed) {
  Random random(seed ^ 0x5e9a7a7eU);
  const int loads =
      circumstances.two_payloads() ? static_cast<int>(circumstances.payloads.size()) : 1;
  const int blocks = circumstances.two_blocks() ? 2 : 1;
  const int each = loads * blocks;
  std::vector<ReadingOption> out;
  const auto offer = [&](const Eigen::VectorXd& q, int again) {
    for (int load = 0; load < loads; ++load)
      for (int block = 0; block < blocks; ++block)
        out.push_back({q,
                       circumstances.approach ? random_approach(cell, circumstances, q, random)
                                              : Eigen::VectorXd(),
                       loads > 1 ? load : -1, block == 1, again});
  };
  if (circumstances.late)
    for (int i = 0; i < std::min(kMostAgain, measured.size()); ++i)
      offer(measured.q.row(i).transpose(), i);
  const Eigen::Index poses = std::min<Eigen::Index>(pool.rows(), std::max(1, most / each));
  for (Eigen::Index i = 0; i < poses; ++i) offer(pool.row(i).transpose(), -1);
  return out;
}

Measurements with_options(const Cell& cell, const Measurements& measured, const Measurements& usual,
                          const std::vector<ReadingOption>& options,
                          const Circumstances& circumstances) {
  const Eigen::Index n = measured.size(), more = static_cast<Eigen::Index>(options.size());
  const Eigen::Index joints = cell.joints();
  const auto& before = measured.context;
  Measurements out = measured;
  out.has_axis = usual.has_axis;
  out.quat_M.resize(0, 4);
  out.nominal_B.resize(0, 3);
  out.departure_B.resize(0, 3);
  out.file.clear();
  out.q.conservativeResize(n + more, joints);
  out.p_M.conservativeResize(n + more, 3);
  out.p_M.bottomRows(more).setZero();
  if (out.sigma_m.rows() > 0) {
    const Eigen::RowVector3d mean = out.sigma_m.colwise().mean();
    out.sigma_m.conservativeResize(n + more, 3);
    out.sigma_m.bottomRows(more).rowwise() = mean;
  }
  RowsN direction(more, joints), travel(more, joints), step(more, joints), load(more, 4);
  RowsN temperature(more, usual.context.temperature.cols());
  auto& c = out.context;
  const bool timed = before.time_s.size() > 0 || n == 0;
  c.time_s.conservativeResize(timed ? n + more : 0);
  c.order.conservativeResize(n + more);
  for (Eigen::Index i = 0; i < n; ++i)
    if (before.order.size() == 0) c.order(i) = static_cast<double>(i);
  int group = 0;
  for (const int g : measured.replicate_group) group = std::max(group, g + 1);
  for (Eigen::Index i = 0; i < more; ++i) {
    const ReadingOption& option = options[static_cast<std::size_t>(i)];
    const Eigen::Index usual_row = i % usual.size();
    out.q.row(n + i) = option.q.transpose();
    out.pose.push_back(fmt::format("option {}", i));
    out.replicate_group.push_back(group + static_cast<int>(i));
    out.set.push_back(SetMark::kUnmarked);
    if (!out.setup.empty()) out.setup.push_back(0);
    if (option.approach.size() > 0) {
      const Eigen::ArrayXd move = option.approach.array();
      direction.row(i) = move.sign().matrix().transpose();
      travel.row(i) = move.abs().matrix().transpose();
      step.row(i) = (move / move.abs().maxCoeff()).matrix().transpose();
    } else {
      direction.row(i) = usual.context.direction.row(usual_row);
      step.row(i) = usual.context.step.row(usual_row);
      travel.row(i).setConstant(3.0 * kUsualMove);
    }
    load.row(i) = row_of(option.payload < 0
                             ? cell.payload
                             : circumstances.payloads[static_cast<std::size_t>(option.payload)]);
    temperature.row(i) = usual.context.temperature.row(usual_row);
    if (option.second_block && circumstances.warm)
      temperature.row(i).array() += circumstances.warmer_K;
    const double later = option.second_block && circumstances.late ? circumstances.later_s : 0.0;
    if (timed) c.time_s(n + i) = usual.context.time_s(usual_row) + later;
    c.order(n + i) = static_cast<double>(n) + (later > 0.0 ? 60.0 : 0.0);
  }
  c.direction = joined(before.direction, n, direction, RowsN::Zero(1, joints));
  // An unknown travel counts as a long one.
  c.travel = joined(before.travel, n, travel, RowsN::Constant(1, joints, 3.0 * kUsualMove));
  c.step = joined(before.step, n, step, RowsN::Zero(1, joints));
  c.payload = joined(before.payload, n, load, row_of(cell.payload));
  c.wrench = joined(before.wrench, n, RowsN::Zero(more, 6), RowsN::Zero(1, 6));
  c.sensors = usual.context.sensors;
  c.temperature = joined(before.temperature, n, temperature, usual.context.temperature.topRows(1));
  return out;
}

std::string instruction(const Circumstances& circumstances, const ReadingOption& option) {
  std::vector<std::string> parts;
  if (circumstances.warm)
    parts.push_back(option.second_block
                        ? "warm: after the arm has run for an hour; record the temperature"
                        : "cold: before any warming up; record the temperature");
  if (circumstances.late)
    parts.push_back(option.second_block ? "an hour after the first ones" : "with the first ones");
  if (option.payload >= 0) {
    const double kg = circumstances.payloads[static_cast<std::size_t>(option.payload)].mass_kg;
    parts.push_back(kg > 0.0 ? fmt::format("with a load of {:.4g} kg", kg) : "without payload");
  }
  if (option.approach.size() > 0)
    parts.push_back("let every joint arrive as dir_j and travel_j say");
  return fmt::format("{}", fmt::join(parts, "; "));
}

}  // namespace plumb::offline
