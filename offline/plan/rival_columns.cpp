// SPDX-License-Identifier: Apache-2.0
#include "plan/rival_columns.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "arm/effect_binding.hpp"
#include "diagnose/constants.hpp"
#include "diagnose/evidence_scale.hpp"
#include "diagnose/regressor_score.hpp"
#include "diagnose/scan.hpp"
#include "effects/registry.hpp"
#include "fit/split.hpp"
#include "noise/noise_floor.hpp"
#include "noise/weights.hpp"
#include "numbers/gaussian.hpp"
#include "solve/evaluation.hpp"

namespace plumb::offline {
namespace {

/// Values of the constants of a law that are tried, and how far [nats] these may be behind the best
/// one.
constexpr std::size_t kMostVariants = 5;
constexpr double kStillPossible_nats = 25.0;

/// Columns of a law at every reading, whitened, and what is known of their sizes.
struct Variant {
  Regressor regressor;
  Eigen::MatrixXd columns;  // shape (lines, b)
  Eigen::VectorXd size;     // of each column, 1 = typical
  double ln_bayes = 0.0, width = 1.0;
};

Regressor rival_regressor(const WhitenedFit& whitened, const EffectEntry& entry) {
  if (!is_wave(entry.name)) return library_regressor(whitened, entry);
  return ripple_regressor(whitened, entry.joints.front(),
                          {number_option(entry, OptionKey::kCyclesPerTurn, 1.0)});
}

/// The entry, and copies of it with the other values of its constants that a diagnosis would try.
std::vector<EffectEntry> with_constants(const WhitenedFit& whitened, const EffectEntry& entry) {
  std::vector<EffectEntry> out{entry};
  if (descriptor_of(entry.name).grid.empty()) return out;
  std::vector<std::string> others;
  for (const EffectDescriptor* effect : effect_descriptors())
    if (effect->name != entry.name) others.emplace_back(effect->name);
  visit_library(whitened, others, [&](const Regressor& regressor) {
    const auto &listed = regressor.entry.joints, &own = entry.joints;
    if (listed.empty() != own.empty()) return;
    if (!own.empty() && listed.front() != own.front()) return;
    out.push_back(entry);
    out.back().options = regressor.entry.options;
  });
  return out;
}

/// Sizes of the columns of `to` that stand for the same numbers as those of `from`.
Eigen::VectorXd carried_over(const Regressor& from, const Eigen::VectorXd& sizes,
                             const Regressor& to) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(to.typical.size());
  for (Eigen::Index c = 0; c < out.size(); ++c)
    for (Eigen::Index k = 0; k < sizes.size(); ++k)
      if (from.members[static_cast<std::size_t>(k)] == to.members[static_cast<std::size_t>(c)])
        out(c) = sizes(k) * from.typical(k) / to.typical(c);
  return out;
}

/// The law with several values of its constants, the likeliest first. at_all: all readings;
/// measured: those made so far, null if there are none.
std::vector<Variant> variants_of(const EffectEntry& entry, const WhitenedFit& at_all,
                                 const WhitenedFit* measured) {
  std::vector<Variant> out;
  if (measured == nullptr) {
    Variant one{.regressor = rival_regressor(at_all, entry), .columns = {}, .size = {}};
    one.size = Eigen::VectorXd::Ones(one.regressor.typical.size());
    out.push_back(std::move(one));
  } else {
    const Scorer scorer(*measured);
    struct Scored {
      EffectEntry entry;
      Regressor regressor;
      RegressorScore score;
    };
    std::vector<Scored> scored;
    for (const auto& tried : with_constants(*measured, entry)) {
      Regressor regressor = rival_regressor(*measured, tried);
      if (regressor.columns.cols() == 0) continue;
      RegressorScore score = scorer.score(regressor);
      scored.push_back({tried, std::move(regressor), std::move(score)});
    }
    std::stable_sort(scored.begin(), scored.end(), [](const Scored& a, const Scored& b) {
      return a.score.evidence.ln_bayes > b.score.evidence.ln_bayes;
    });
    for (const auto& one : scored) {
      const Evidence& found = one.score.evidence;
      if (out.size() == kMostVariants) break;
      if (!out.empty() && found.ln_bayes < out.front().ln_bayes - kStillPossible_nats) break;
      Variant variant{.regressor = rival_regressor(at_all, one.entry), .columns = {}, .size = {}};
      variant.size = carried_over(one.regressor, one.score.theta, variant.regressor);
      if (variant.size.squaredNorm() == 0.0) variant.size.setOnes();
      variant.ln_bayes = found.ln_bayes;
      variant.width = found.width;
      out.push_back(std::move(variant));
    }
    if (out.empty()) return variants_of(entry, at_all, nullptr);
  }
  for (auto& variant : out) variant.columns = motions(at_all, variant.regressor);
  return out;
}

void add_numbers(const Cell& cell, const Measurements& at, const Variant& variant,
                 Eigen::Index first, RivalColumns& out) {
  format::Model model;
  model.calibrated = cell.nominal;
  model.effects = {bind_effect(cell, at, variant.regressor.entry)};
  for (Eigen::Index c = 0; c < variant.regressor.typical.size(); ++c) {
    const int member = variant.regressor.members[static_cast<std::size_t>(c)];
    out.numbers.push_back({effect_parameter_name(model, 0, member),
                           std::string(effect_parameter(model, 0, member).unit),
                           variant.regressor.typical(c), first + c});
  }
}

}  // namespace

RivalColumns rival_columns(const Cell& as_measured, const PlanStart& start, const EffectEntry& a,
                           const EffectEntry& b, const std::vector<ReadingOption>& options,
                           const Circumstances& circumstances) {
  Cell cell = as_measured;
  cell.measurement.sigma_rad.reset();  // poses are chosen by the points that they will show
  const Measurements none = nothing_measured(cell);
  const Measurements& used = start.calibration ? start.used : none;
  const Measurements all = with_options(cell, used, start.pool, options, circumstances);
  const int n = used.size();
  const DesignSpace space = design_space(cell, start.state, start.pool, start.sigma_m, 0.0);
  std::vector<int> fit, held;
  RivalColumns out;
  if (n > 0) {
    const Split split = split_poses(used, cell.measurement.held_out, cell.measurement.seed);
    fit = fit_rows(split);
    out.rivals.fit_share = static_cast<double>(fit.size()) / n;
    fit = without_outliers(fit, start.calibration->outliers);
  }
  for (int i = n; i < all.size(); ++i) (n > 0 ? held : fit).push_back(i);
  Calibration nominal;
  nominal.state = start.state;
  nominal.parameters = space.parameters;
  const Calibration& calibration = start.calibration ? *start.calibration : nominal;
  const WhitenedFit at_all = make_whitened_fit(cell, all, calibration, fit, held);
  std::optional<WhitenedFit> measured;
  if (n > 0) measured = make_whitened_fit(cell, all, calibration, fit, {});
  const std::vector<Variant> first = variants_of(a, at_all, measured ? &*measured : nullptr);
  const std::vector<Variant> second = variants_of(b, at_all, measured ? &*measured : nullptr);
  if (n > 0) out.today = first.front().ln_bayes - second.front().ln_bayes;

  FitData data;
  data.measured = &all;
  data.rows = at_all.row;
  data.sigma_m = stated_sigma(cell, all);
  const Eigen::MatrixXd G =
      evaluate(data, start.state, space.parameters).jacobian * space.width.asDiagonal();
  out.parameters = static_cast<int>(space.size());

  Eigen::Index columns = 2;
  for (const auto* law : {&first, &second})
    for (const auto& variant : *law) columns += variant.columns.cols();
  Eigen::MatrixXd Z(G.rows(), columns);
  Eigen::Index at = 0;
  const auto put_law = [&](const std::vector<Variant>& variants, Rivals::Law& law) {
    add_numbers(cell, all, variants.front(), at, out);
    for (const auto& variant : variants) {
      law.variants.push_back({at, variant.columns.cols(), variant.width});
      Z.middleCols(at, variant.columns.cols()) = variant.columns;
      at += variant.columns.cols();
    }
  };
  put_law(first, out.rivals.a);
  put_law(second, out.rivals.b);
  out.rivals.a.expected = at;
  out.rivals.b.expected = at + 1;
  const Eigen::Index lines = n > 0 ? at_all.fit_lines : 0;
  const auto known = G.topRows(lines);
  const Cholesky llt(with_prior(known.transpose() * known));
  const auto expect = [&](const Variant& variant, Eigen::Index column) {
    const Eigen::VectorXd motion = variant.columns * variant.size;
    Z.col(column) = motion;
    // The readings made, and the geometry that was fitted to them in place of the effect.
    if (lines == 0) return;
    Z.col(column).head(lines) =
        at_all.y.head(lines) + known * llt.solve(known.transpose() * motion.head(lines));
  };
  expect(first.front(), out.rivals.a.expected);
  expect(second.front(), out.rivals.b.expected);

  if (measured) {
    out.rivals.scale = evidence_scale(*measured);
  } else {
    NoiseFloor stated;
    stated.source = NoiseFloor::Source::kSigma;
    out.rivals.scale = {
        .variance = 1.0, .dof = trusted_dof(stated), .lines = -1.0 * out.parameters};
  }
  out.noise_variance = out.rivals.scale.variance;
  out.known_G = known;
  out.known_Z = Z.topRows(lines);
  out.G.resize(options.size());
  out.Z.resize(options.size());
  const double root = std::sqrt(out.rivals.fit_share);
  for (std::size_t i = 0; i < at_all.row.size(); ++i) {
    if (at_all.row[i] < n) continue;
    const auto option = static_cast<std::size_t>(at_all.row[i] - n);
    const auto reading = static_cast<Eigen::Index>(i);
    const Eigen::Index line = at_all.table.begin(reading), count = at_all.table.count(reading);
    out.G[option] = root * G.middleRows(line, count);
    out.Z[option] = root * Z.middleRows(line, count);
  }
  return out;
}

}  // namespace plumb::offline
