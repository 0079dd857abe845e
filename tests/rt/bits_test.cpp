// SPDX-License-Identifier: Apache-2.0
// The same bits with every compiler, optimisation and instruction set: one hash for all of them.
#include <gtest/gtest.h>

#include <bit>

#include "plumb/runtime/corrector.hpp"
#include "plumb/runtime/elementary.hpp"
#include "tests/random_numbers.hpp"
#include "tests/rt/cycle_model.hpp"

namespace plumb {
namespace {

constexpr int kCount = 1'000'000;
constexpr int kCorrected = 10;  // every tenth prediction is also corrected
constexpr std::uint64_t kSeed = 7;

/// FNV-1a over the bits of doubles.
class Hash {
 public:
  void add(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    for (int shift = 0; shift < 64; shift += 8) {
      value_ ^= (bits >> shift) & 0xFF;
      value_ *= 0x100000001b3U;
    }
  }
  void add(const Transformd& X) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) add(X.R(i, j));
      add(X.p(i));
    }
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

TEST(Bits, OfElementaryFunctionsAreTheSameEverywhere) {
  tests::Random random(kSeed);
  Hash hash;
  for (int i = 0; i < kCount; ++i) {
    const double x = random.uniform(-1e5, 1e5), y = random.uniform(-700.0, 700.0);
    const double z = random.uniform(1e-3, 1e3), u = random.uniform(-2.0, 2.0);
    const auto t = portable::sin_cos(x);
    for (double value : {t.sin, t.cos, portable::atan2(x, y), portable::exp(y), portable::log(z),
                         portable::tanh(u), portable::pow(z, u), portable::sqrt(z)})
      hash.add(value);
  }
  std::printf("%d inputs, seed %d: %016llx\n", kCount, static_cast<int>(kSeed),
              static_cast<unsigned long long>(hash.value()));
  EXPECT_EQ(hash.value(), 0x1a4d2de21ff6fac1U);
}

std::uint64_t hash_of(const format::Model& model, const Context& context = {}) {
  const Corrector corrector(model);
  tests::Random random(kSeed);
  Hash hash;
  for (int i = 0; i < kCount; ++i) {
    std::array<double, 6> q{};
    for (double& x : q) x = random.uniform(-3.2, 3.2);
    const Prediction prediction = corrector.forward_model().predict(q, context);
    hash.add(prediction.X_BT);
    if (i % kCorrected != 0) continue;
    for (double& x : q) x += random.uniform(-0.01, 0.01);
    const Correction correction = corrector.solve(prediction.X_BT, q, SeedKind::kMeasured, context);
    hash.add(correction.X_BC);
    hash.add(static_cast<double>(correction.status));
  }
  std::printf("%d inputs, seed %d: %016llx\n", kCount, static_cast<int>(kSeed),
              static_cast<unsigned long long>(hash.value()));
  return hash.value();
}

TEST(Bits, OfThePredictionAndTheCorrectionAreTheSameEverywhere) {
  EXPECT_EQ(hash_of(tests::one_arm()), 0x90087351d035e4bdU);
}

TEST(Bits, OfAnArmWithSixEffectsAndLargeTreesAreTheSameEverywhere) {
  Context context;
  context.direction = {1.0, -1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
  context.travel.fill(0.02);
  EXPECT_EQ(hash_of(tests::cycle_model(), context), 0x21a4d1b48b246deaU);
}

TEST(Bits, OfAnArmWithBlendedTreesAreTheSameEverywhere) {
  EXPECT_EQ(hash_of(tests::blended_arm()), 0x3b33532c0d823b1aU);
}

TEST(Bits, OfBlendedTreesAloneAreTheSameEverywhere) {
  const format::Model model = tests::blended_arm();
  const ForwardModel arm(model);
  tests::Random random(kSeed);
  Hash hash;
  long moved = 0;
  for (int i = 0; i < kCount; ++i) {
    std::array<double, 6> q{};
    for (double& x : q) x = random.uniform(-3.2, 3.2);
    const Vector3 error = arm.tree_error(q);
    for (int axis = 0; axis < 3; ++axis) hash.add(error(axis));
    moved += error.norm() > 1e-6 ? 1 : 0;
  }
  std::printf("%d inputs, seed %d: %016llx\n", kCount, static_cast<int>(kSeed),
              static_cast<unsigned long long>(hash.value()));
  EXPECT_GT(moved, kCount / 3);
  EXPECT_EQ(hash.value(), 0xf9b7506ccd7969a3U);
}

}  // namespace
}  // namespace plumb
