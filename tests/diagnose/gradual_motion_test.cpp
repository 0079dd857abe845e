// SPDX-License-Identifier: Apache-2.0
// A step, and what moves slowly instead.
#include "diagnose/gradual_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "diagnose/change_points.hpp"
#include "diagnose/constants.hpp"
#include "effects/effect_option.hpp"
#include "effects/registry.hpp"
#include "tests/diagnose/hiding.hpp"
#include "tests/diagnose/whitened_arm.hpp"

namespace plumb::offline {
namespace {

struct GradualMotion : testing::Test {
  GradualMotion() {
    for (Eigen::Index i = 0; i < arm.poses(); ++i)
      last_order = std::max(last_order, arm.context[i].order);
  }
  EffectEntry step_at(double share) const {
    EffectEntry out = entry_of(change_point_effect());
    set_option(out, OptionKey::kOf, std::string("tool"));
    set_option(out, OptionKey::kAfterRow, std::round(share * last_order));
    return out;
  }
  /// The reflector moves along by this function of the place in the series, 0 to 1.
  WhitenedFit moving(const std::function<double(double)>& along, double size = 5.0) const {
    Eigen::VectorXd lines = Eigen::VectorXd::Zero(arm.y.size());
    for (Eigen::Index i = 0; i < arm.poses(); ++i)
      lines.segment(3 * i, 3) = along(arm.context[i].order / last_order) *
                                arm.tool.middleRows(3 * i, 3) * Eigen::Vector3d(1.0, -0.7, 0.5);
    lines *= size * std::sqrt(static_cast<double>(lines.size())) / lines.norm();
    return leaving(arm, noise_of(arm, 71) + lines);
  }
  /// The best step there, as a scan lists it.
  Found best_step(const WhitenedFit& s, double share) const {
    Found best;
    best.scored.evidence.ln_bayes = kImpossible;
    const Scorer scorer(s);
    for (double at = std::max(0.06, share - 0.3); at < share + 0.3; at += 0.02) {
      const EffectEntry entry = step_at(at);
      const double row = number_option(entry, OptionKey::kAfterRow, 0.0);
      RegressorScore scored = scorer.score(moves_regressor(s, entry, {row}));
      if (scored.evidence.ln_bayes <= best.ln_bayes()) continue;
      best = Found{entry, {}, std::move(scored), {}, 0.0, {}, 0.0};
    }
    return best;
  }

  const WhitenedFit& arm = whitened_arm().whitened;
  double last_order = 0.0;
};

TEST_F(GradualMotion, ThatIsThereReplacesTheStepThatImitatesIt) {
  for (const double length : {0.2, 0.4}) {
    const WhitenedFit s =
        moving([&](double at) { return std::clamp((at - 0.5) / length + 0.5, 0.0, 1.0); });
    const Found step = best_step(s, 0.5);
    const auto found = gradual_motion_instead_of(s, step);
    ASSERT_TRUE(found) << length;
    EXPECT_GT(found->ln_bayes(), step.ln_bayes() + kSupported);
    EXPECT_TRUE(found->pattern.slow);
    EXPECT_FALSE(found->pattern.subject.empty());
    EXPECT_TRUE(says(found->pattern.words, "moves gradually, from")) << found->pattern.words;
    EXPECT_TRUE(found->entry.name.empty()) << "no law of the library";
  }
}

TEST_F(GradualMotion, IsAJumpThatDecaysWhereOneIsThere) {
  const WhitenedFit s =
      moving([](double at) { return at < 0.4 ? 0.0 : std::exp(-(at - 0.4) / 0.1); });
  const auto found = gradual_motion_instead_of(s, best_step(s, 0.4));
  ASSERT_TRUE(found);
  EXPECT_TRUE(says(found->pattern.words, "jumps at 4")) << found->pattern.words;
  EXPECT_TRUE(says(found->pattern.words, "moves back")) << found->pattern.words;
}

TEST_F(GradualMotion, IsNoneOfAStepThatIsAbrupt) {
  for (const double at : {0.3, 0.5, 0.7}) {
    const WhitenedFit s = moving([&](double place) { return place < at ? 0.0 : 1.0; });
    EXPECT_FALSE(gradual_motion_instead_of(s, best_step(s, at))) << at;
  }
}

TEST_F(GradualMotion, IsNoneOfWhatIsNoStep) {
  const WhitenedFit s = moving([](double at) { return at; });
  Found gear;
  gear.entry = entry_of("gear_harmonics", {1});
  gear.scored.evidence.ln_bayes = 0.0;
  EXPECT_FALSE(gradual_motion_instead_of(s, gear));
}

}  // namespace
}  // namespace plumb::offline
