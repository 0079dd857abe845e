// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "numbers/cholesky.hpp"
#include "plan/plan_steps.hpp"
#include "plan/rival_columns.hpp"

namespace plumb::offline {
namespace {

/// Readings that are chosen from, and rounds in which the choice is improved among readings at
/// neighbouring poses. They bound the time.
constexpr int kMostOptions = 3000, kRoundsBeside = 6;
constexpr std::size_t kMostBeside = 1000;
/// Ridge, as a share of the largest diagonal element, for columns that depend on each other.
constexpr double kTrace = 1e-9;
/// Two laws are one and the same if each reproduces this share of the motion of the other.
constexpr double kOneMotion = 0.9999;
/// Poses do not show a number whose 1 sigma is larger than this, in typical sizes.
constexpr double kShown = 100.0;

using Law = Rivals::Law;

/// Share of the motion of a law, geometry being free, that the other one reproduces.
std::optional<double> reproduced(const Eigen::MatrixXd& S, const Law::Variant& own,
                                 const Law::Variant& other) {
  const auto A = S.block(own.first, own.first, own.count, own.count);
  if (!(A.trace() > static_cast<double>(own.count))) return std::nullopt;
  Eigen::MatrixXd B = S.block(other.first, other.first, other.count, other.count);
  B.diagonal().array() += kTrace * B.diagonal().maxCoeff() + 1e-300;
  const auto AB = S.block(own.first, other.first, own.count, other.count);
  const double share = (AB * SymmetricSolver(B).solve(AB.transpose())).trace();
  return std::clamp(share / A.trace(), 0.0, 1.0);
}

Reproduction reproduction_of(const Eigen::MatrixXd& S, const Rivals& rivals) {
  const auto &a = rivals.a.variants.front(), &b = rivals.b.variants.front();
  return {reproduced(S, a, b), reproduced(S, b, a)};
}

/// 1 sigma of every column of the first variants, both laws and geometry being free.
Eigen::VectorXd sigma_of_sizes(const Eigen::MatrixXd& S, const RivalColumns& columns) {
  std::vector<Eigen::Index> both;
  for (const auto& number : columns.numbers) both.push_back(number.column);
  Eigen::MatrixXd M = S(both, both);
  M.diagonal().array() += 1e-12 * M.diagonal().maxCoeff() + 1e-300;
  const Eigen::MatrixXd C = SymmetricSolver(M).inverse();
  return (C.diagonal().cwiseMax(0.0) * columns.noise_variance).cwiseSqrt();
}

void tell_numbers(const Eigen::MatrixXd& before, const Eigen::MatrixXd& after,
                  const RivalColumns& columns, PosePlan& out) {
  const Eigen::VectorXd was = sigma_of_sizes(before, columns), is = sigma_of_sizes(after, columns);
  for (std::size_t i = 0; i < columns.numbers.size(); ++i) {
    const auto& number = columns.numbers[i];
    const auto k = static_cast<Eigen::Index>(i);
    EffectSigma sigma{number.name, number.unit, {}, is(k) * number.typical};
    if (columns.known_G.rows() > 0 && was(k) < kShown) sigma.before = was(k) * number.typical;
    out.numbers.push_back(std::move(sigma));
  }
}

std::string in_words(const Cell& cell, const EffectEntry& entry) {
  std::string out = entry.name;
  for (std::size_t i = 0; i < entry.joints.size(); ++i)
    out +=
        (i == 0 ? ":" : "+") + cell.nominal.joints[static_cast<std::size_t>(entry.joints[i])].name;
  return out;
}

/// Refuses two laws that move the point alike at all readings that could be made.
void refuse_one_motion(const Cell& cell, const PlanRequest& request, const RivalColumns& columns,
                       const Circumstances& circumstances) {
  if (circumstances.load_matters && !circumstances.two_payloads()) return;
  ClearedProducts all(columns.known_G, columns.known_Z);
  for (std::size_t i = 0; i < columns.G.size(); ++i) all.add(columns.G[i], columns.Z[i]);
  const Reproduction share = reproduction_of(all.products(), columns.rivals);
  if (std::min(share.a_by_b.value_or(0.0), share.b_by_a.value_or(0.0)) < kOneMotion) return;
  throw Failure(
      Exit::kNumbersSayNo,
      {.code = "E-PLAN-SAME",
       .message =
           fmt::format("no measurement of the point tells {} from {}: they move it alike, "
                       "whatever the pose",
                       in_words(cell, request.separate[0]), in_words(cell, request.separate[1])),
       .help = "add either: the corrected positions are the same; only a look into the arm tells "
               "which it is"});
}

void say_which_load(const Circumstances& circumstances, PosePlan& out) {
  if (!circumstances.load_matters || circumstances.two_payloads()) return;
  out.remarks.push_back(
      {.severity = Severity::kNote,
       .code = "N-PLAN-PAYLOAD",
       .message = "a second payload would help to tell the two apart, but how heavy a load can be "
                  "mounted is not known: planned for poses alone",
       .help =
           "state the loads in kg, with the centre of mass of [robot] payload: --payload 0,10"});
}

/// First blocks first, then load by load, each in driving order.
void write_down(const Cell& cell, const PlanStart& start, const std::vector<ReadingOption>& chosen,
                PosePlan& out) {
  std::vector<std::pair<bool, int>> groups;
  for (const auto& option : chosen) groups.emplace_back(option.second_block, option.payload);
  std::sort(groups.begin(), groups.end());
  groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
  for (const auto& [block, payload] : groups) {
    std::vector<const ReadingOption*> members;
    for (const auto& option : chosen)
      if (option.second_block == block && option.payload == payload) members.push_back(&option);
    RowsN q(static_cast<Eigen::Index>(members.size()), cell.joints());
    for (std::size_t i = 0; i < members.size(); ++i)
      q.row(static_cast<Eigen::Index>(i)) = members[i]->q.transpose();
    for (const int i : driven(cell, start, q, out.drive)) {
      const ReadingOption& option = *members[static_cast<std::size_t>(i)];
      out.poses.push_back({.name = fmt::format("N{:03}", out.poses.size() + 1),
                           .q = option.q,
                           .note = instruction(out.circumstances, option),
                           .how = option});
    }
  }
}

/// Readings that are chosen of options, and what they tell.
struct Chosen {
  RivalColumns columns;
  std::vector<ReadingOption> readings;
  Choice choice;
  double least() const {
    return quick_leads(columns.rivals, choice.products, choice.further).least();
  }
};

Chosen chosen_of(const std::vector<ReadingOption>& options, RivalColumns columns, int n) {
  const ClearedProducts known(columns.known_G, columns.known_Z);
  Choice choice = choose_readings(columns.rivals, known, columns.G, columns.Z, n);
  std::vector<ReadingOption> readings;
  for (const int i : choice.chosen) readings.push_back(options[static_cast<std::size_t>(i)]);
  return {std::move(columns), std::move(readings), std::move(choice)};
}

/// The chosen readings, and about `most` more at poses beside theirs.
std::vector<ReadingOption> options_beside(const Cell& cell, const PlanStart& start,
                                          const PoseRules& rules,
                                          const Circumstances& circumstances,
                                          const std::vector<ReadingOption>& chosen,
                                          std::size_t most, Random& random) {
  std::vector<ReadingOption> out = chosen;
  while (out.size() < std::max(most, 2 * chosen.size())) {
    const std::size_t i = out.size() % chosen.size();
    const Eigen::VectorXd q = pose_beside(cell, start.state, rules, chosen[i].q, random);
    out.push_back(option_at(cell, circumstances, q, chosen[i], random));
  }
  return out;
}

}  // namespace

void plan_separation(const Cell& cell, const PlanStart& start, const PlanRequest& request,
                     PosePlan& out) {
  const EffectEntry &a = request.separate[0], &b = request.separate[1];
  const PoseRules& rules = request.rules;
  out.circumstances = circumstances_of(cell, start.used, a, b, request.payloads_kg);
  say_which_load(out.circumstances, out);
  const auto columns_of = [&](const std::vector<ReadingOption>& options) {
    return rival_columns(cell, start, a, b, options, out.circumstances);
  };
  const auto options = reading_options(cell, start.used, start.pool.q, out.circumstances,
                                       std::min(kMostOptions, rules.pool), rules.seed);
  RivalColumns columns = columns_of(options);
  refuse_one_motion(cell, request, columns, out.circumstances);
  Chosen best = chosen_of(options, std::move(columns), request.n);
  Random random(rules.seed ^ 0xbe51deU);
  for (int round = 0; round < kRoundsBeside; ++round) {
    const auto more = options_beside(cell, start, rules, out.circumstances, best.readings,
                                     std::min(options.size(), kMostBeside), random);
    Chosen other = chosen_of(more, columns_of(more), request.n);
    if (other.least() > best.least()) best = std::move(other);
  }
  const RivalColumns& at = best.columns;
  const ClearedProducts known(at.known_G, at.known_Z);
  const Eigen::MatrixXd& products = best.choice.products;
  const Leads leads = exact_leads(at.rivals, products, best.choice.further);
  out.parameters = at.parameters;
  out.expected = {at.today, leads.if_a, leads.if_b};
  out.apart_before = reproduction_of(known.products(), at.rivals);
  out.apart_after = reproduction_of(products, at.rivals);
  tell_numbers(known.products(), products, at, out);
  write_down(cell, start, best.readings, out);
}

}  // namespace plumb::offline
