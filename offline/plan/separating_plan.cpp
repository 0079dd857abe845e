// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "effects/registry.hpp"
#include "fit/effect_binding.hpp"
#include "plan/plan_steps.hpp"

namespace plumb::offline {
namespace {

constexpr double kUsualLoad_kg = 5.0;
constexpr double kRidge = 1e-9;
constexpr double kShown = 0.2;  // largest 1 sigma, in widths, of a parameter that poses show

/// The two effects among the parameters.
struct Pair {
  std::vector<Eigen::Index> a, b, rest;

  std::vector<Eigen::Index> with(const std::vector<Eigen::Index>& effect) const {
    std::vector<Eigen::Index> out = rest;
    out.insert(out.end(), effect.begin(), effect.end());
    return out;
  }
  std::vector<Eigen::Index> both() const {
    std::vector<Eigen::Index> out = with(a);
    out.insert(out.end(), b.begin(), b.end());
    return out;
  }
};

const EffectInfo& info_of(const EffectEntry& entry) { return *descriptor_of(entry.name).law; }

/// Place of the entry among the effects of the arm; added if it is not there.
int place_of(const Cell& cell, const EffectEntry& entry, const Measurements& at, ArmState& state) {
  format::Effect bound = bind_effect(cell, at, entry);
  auto& effects = state.arm.effects;
  for (std::size_t i = 0; i < effects.size(); ++i)
    if (effects[i].name == bound.name && effects[i].joints == bound.joints)
      return static_cast<int>(i);
  effects.push_back(std::move(bound));
  const auto place = static_cast<int>(effects.size()) - 1;
  auto& numbers = effects.back().parameters;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const auto& p = effect_parameter(state.arm, place, static_cast<int>(k));
    if (!p.linear) numbers[k] = p.start;
  }
  return place;
}

Pair pair_of(const DesignSpace& space, int a, int b) {
  Pair out{space.columns_of_effect(a), space.columns_of_effect(b), {}};
  for (Eigen::Index i = 0; i < space.size(); ++i) {
    const auto is = [&](const auto& list) {
      return std::find(list.begin(), list.end(), i) != list.end();
    };
    if (!is(out.a) && !is(out.b)) out.rest.push_back(i);
  }
  return out;
}

DesignCriterion apart(const Pair& pair) {
  return {{{pair.both(), 2.0}, {pair.with(pair.a), -1.0}, {pair.with(pair.b), -1.0}}};
}

/// Projects the other parameters out of both effects, then compares each with the other.
Reproduction reproduction(const Eigen::MatrixXd& lines, const Pair& pair) {
  Eigen::MatrixXd M = lines.transpose() * lines;
  M.diagonal().array() += 1.0;
  std::vector<Eigen::Index> two = pair.a;
  two.insert(two.end(), pair.b.begin(), pair.b.end());
  const Eigen::MatrixXd cross = M(pair.rest, two);
  Eigen::MatrixXd S = M(two, two);
  if (!pair.rest.empty()) S -= cross.transpose() * M(pair.rest, pair.rest).ldlt().solve(cross);
  const auto na = static_cast<Eigen::Index>(pair.a.size());
  const auto nb = static_cast<Eigen::Index>(pair.b.size());
  const auto share = [](const Eigen::MatrixXd& own, Eigen::MatrixXd other,
                        const Eigen::MatrixXd& between) -> std::optional<double> {
    if (own.trace() < static_cast<double>(own.rows()) / (kShown * kShown)) return std::nullopt;
    other.diagonal().array() += kRidge * other.diagonal().maxCoeff();
    return std::clamp((between * other.ldlt().solve(between.transpose())).trace() / own.trace(),
                      0.0, 1.0);
  };
  const Eigen::MatrixXd A = S.topLeftCorner(na, na), B = S.bottomRightCorner(nb, nb);
  const Eigen::MatrixXd AB = S.topRightCorner(na, nb);
  return {share(A, B, AB), share(B, A, AB.transpose())};
}

/// Poses under a contrast: one block of both measurements a pose.
struct Candidates {
  std::vector<Eigen::MatrixXd> blocks;
  Contrast contrast = Contrast::kNone;
};

Candidates under(Contrast contrast, const DesignSpace& space, const Measurements& pool,
                 const ContrastSizes& sizes) {
  Measurements first = pool;
  apply_contrast(contrast, false, sizes, first.context);
  Candidates out{blocks(space.lines(first), space.per_pose()), contrast};
  if (contrast == Contrast::kNone) return out;
  Measurements second = pool;
  apply_contrast(contrast, false, sizes, second.context);
  apply_contrast(contrast, true, sizes, second.context);
  const auto again = blocks(space.lines(second), space.per_pose());
  for (std::size_t i = 0; i < again.size(); ++i) {
    Eigen::MatrixXd both(2 * space.per_pose(), space.size());
    both << out.blocks[i], again[i];
    out.blocks[i] = std::move(both);
  }
  return out;
}

ContrastSizes sizes_of(const Cell& cell, const Measurements& used) {
  ContrastSizes out;
  out.payload_kg = cell.payload.mass_kg;
  if (used.context.payload.rows() > 0)
    for (const double kg : used.context.payload.col(0))
      if (kg > out.payload_kg) out.payload_kg = kg;
  if (!(out.payload_kg > 0.0)) out.payload_kg = kUsualLoad_kg;
  return out;
}

/// Value of the first poses of the pool under a contrast; a part of the pool is enough to choose.
double promise(const Candidates& candidates, const Eigen::MatrixXd& known, const DesignSpace& space,
               const DesignCriterion& criterion, int n) {
  double out = 0.0;
  for (const auto& term : criterion.terms) {
    Information information(space.prior()(term.columns));
    information.add(known(Eigen::all, term.columns));
    const double before = information.ln_det();
    const int each = candidates.contrast == Contrast::kNone ? 1 : 2;
    for (int i = 0; i < std::min(n / each, static_cast<int>(candidates.blocks.size())); ++i)
      information.add(candidates.blocks[static_cast<std::size_t>(i)](Eigen::all, term.columns));
    out += term.weight * (information.ln_det() - before);
  }
  return out;
}

void tell_numbers(const DesignSpace& space, const Pair& pair, const Eigen::MatrixXd& before,
                  const Eigen::MatrixXd& after, PosePlan& out) {
  for (const auto* effect : {&pair.a, &pair.b})
    for (const Eigen::Index i : *effect) {
      const Parameter& p = space.parameters[static_cast<std::size_t>(i)];
      EffectSigma sigma{p.name,
                        effect_parameter(space.state.arm, p.joint, p.component).unit,
                        {},
                        std::sqrt(after(i, i)) * space.width(i)};
      if (std::sqrt(before(i, i)) < kShown) sigma.before = std::sqrt(before(i, i)) * space.width(i);
      out.numbers.push_back(std::move(sigma));
    }
}

void write_down(const Measurements& pool, const std::vector<int>& order, PosePlan& out) {
  const auto add = [&](int number, bool second) {
    const auto name = fmt::format("N{:03}", number + 1);
    out.poses.push_back({.name = name,
                         .q = pool.q.row(order[static_cast<std::size_t>(number)]).transpose(),
                         .second = second,
                         .note = instruction(out.contrast, second)});
  };
  const auto n = static_cast<int>(order.size());
  for (int i = 0; i < n; ++i) {
    add(i, false);
    if (one_by_one(out.contrast)) add(i, true);
  }
  if (out.contrast == Contrast::kNone || one_by_one(out.contrast)) return;
  for (int i = 0; i < n; ++i) add(i, true);
}

}  // namespace

void plan_separation(const Cell& cell, const PlanStart& start, const PlanRequest& request,
                     PosePlan& out) {
  ArmState state = start.state;
  const int a = place_of(cell, request.separate[0], start.pool, state);
  const int b = place_of(cell, request.separate[1], start.pool, state);
  Measurements typical = start.pool;  // every law does something there
  out.sizes = sizes_of(cell, start.used);
  typical.context.payload.col(0).setConstant(out.sizes.payload_kg);
  typical.context.temperature.array() += out.sizes.warmer_K;
  typical.context.time_s.array() += out.sizes.later_s;
  typical.context.order.array() += 1e6;
  typical.context.wrench.leftCols<3>().setConstant(out.sizes.pull_N);
  const DesignSpace space = design_space(cell, state, typical, start.sigma_m, start.sigma_rad);
  const Pair pair = pair_of(space, a, b);
  const DesignCriterion criterion = apart(pair);
  const Eigen::MatrixXd known = space.lines(start.used);
  auto contrasts = separating_contrasts(info_of(request.separate[0]), info_of(request.separate[1]));
  Candidates best = under(Contrast::kNone, space, start.pool, out.sizes);
  double most = contrasts.empty() ? 0.0 : -1e300;
  for (const auto contrast : contrasts) {
    Candidates candidates = under(contrast, space, start.pool, out.sizes);
    const double value = promise(candidates, known, space, criterion, request.n);
    if (value > most) most = value, best = std::move(candidates);
  }
  out.contrast = best.contrast;
  std::erase(contrasts, best.contrast);
  out.others = contrasts;
  const int each = best.contrast == Contrast::kNone ? 1 : 2;
  const Design design =
      d_optimal(best.blocks, known, space.prior(), std::max(1, request.n / each), criterion);
  Information information(space.prior());
  information.add(known);
  out.parameters = static_cast<int>(space.size());
  const Eigen::MatrixXd before = information.covariance();
  Eigen::MatrixXd all = known;
  for (const int i : design.chosen) {
    const auto& block = best.blocks[static_cast<std::size_t>(i)];
    information.add(block);
    all.conservativeResize(all.rows() + block.rows(), Eigen::NoChange);
    all.bottomRows(block.rows()) = block;
  }
  tell_numbers(space, pair, before, information.covariance(), out);
  out.ln_det = design.value;
  out.apart_before = reproduction(known, pair);
  out.apart_after = reproduction(all, pair);
  write_down(start.pool, driven(cell, start, design.chosen, out.drive), out);
}

}  // namespace plumb::offline
