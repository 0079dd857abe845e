// SPDX-License-Identifier: Apache-2.0
// The same bits with every compiler, optimisation and instruction set: one hash for all of them.
#include <gtest/gtest.h>

#include <memory>

#include "plumb/runtime/corrector.hpp"
#include "plumb/runtime/detail/elementary.hpp"
#include "tests/bit_hash.hpp"
#include "tests/random_numbers.hpp"
#include "tests/rt/cycle_model.hpp"
#include "tests/rt/laws/random_life.hpp"

namespace plumb {
namespace {

constexpr int kCount = 1'000'000;
constexpr int kFirst = 20'000;
constexpr int kCorrected = 10;  // every tenth prediction is also corrected
constexpr std::uint64_t kSeed = 7;

/// one_input(hash) for every input; a run that is scaled down stops at the first few.
template <class F>
void expect_bits(F one_input, std::uint64_t of_the_first, std::uint64_t of_all) {
  const bool all = tests::scaled(kCount) >= kCount;
  tests::BitHash hash;
  for (int i = 0; i < kFirst; ++i) one_input(hash);
  std::printf("%d inputs, seed %d: %016llx\n", kFirst, static_cast<int>(kSeed),
              static_cast<unsigned long long>(hash.value()));
  EXPECT_EQ(hash.value(), of_the_first);
  if (!all) return;
  for (int i = kFirst; i < kCount; ++i) one_input(hash);
  std::printf("%d inputs, seed %d: %016llx\n", kCount, static_cast<int>(kSeed),
              static_cast<unsigned long long>(hash.value()));
  EXPECT_EQ(hash.value(), of_all);
}

TEST(Bits, OfElementaryFunctionsAreTheSameEverywhere) {
  tests::Random random(kSeed);
  const auto one_input = [&](tests::BitHash& hash) {
    const double x = random.uniform(-1e5, 1e5), y = random.uniform(-700.0, 700.0);
    const double z = random.uniform(1e-3, 1e3), u = random.uniform(-2.0, 2.0);
    const auto t = portable::sin_cos(x);
    for (double value : {t.sin, t.cos, portable::atan2(x, y), portable::exp(y), portable::log(z),
                         portable::tanh(u), portable::pow(z, u), portable::sqrt(z)})
      hash.add(value);
  };
  expect_bits(one_input, 0x635c03cc0b32ef3dU, 0x1a4d2de21ff6fac1U);
}

/// Predictions, and every tenth corrected.
class Arm {
 public:
  explicit Arm(const format::Model& model, const Context& context = {})
      : corrector_(model), context_(context) {}

  void operator()(tests::BitHash& hash) {
    std::array<double, 6> q{};
    for (double& x : q) x = random_.uniform(-3.2, 3.2);
    const Prediction prediction = corrector_.forward_model().predict(q, context_);
    hash.add(prediction.X_BT);
    if (count_++ % kCorrected != 0) return;
    for (double& x : q) x += random_.uniform(-0.01, 0.01);
    const Correction correction =
        corrector_.solve(prediction.X_BT, q, SeedKind::kMeasured, context_);
    hash.add(correction.X_BC);
    hash.add(static_cast<double>(correction.status));
  }

 private:
  Corrector corrector_;
  Context context_;
  tests::Random random_{kSeed};
  int count_ = 0;
};

TEST(Bits, OfThePredictionAndTheCorrectionAreTheSameEverywhere) {
  const format::Model model = tests::one_arm();
  expect_bits(Arm(model), 0xb98ee1cee0c15a1fU, 0xa6622445708395a4U);
}

TEST(Bits, OfAnArmWithSixEffectsAndLargeTreesAreTheSameEverywhere) {
  const format::Model model = tests::cycle_model();
  Context context;
  context.direction = {1.0, -1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
  context.travel.fill(0.02);
  expect_bits(Arm(model, context), 0xe069aff76ac9ff5eU, 0x2fa7125b441413dbU);
}

TEST(Bits, OfAnArmWithBlendedTreesAreTheSameEverywhere) {
  const format::Model model = tests::blended_arm();
  expect_bits(Arm(model), 0x8b93f9cf8dc87435U, 0xae5a6c319589c65dU);
}

/// All that is said of random arms of one to nine joints, of every law and kind of tree, a new one
/// every 200 inputs, by turns for positions only and for poses.
class ManyArms {
 public:
  void operator()(tests::BitHash& hash) {
    if (count_ % kInputsPerArm == 0) renew();
    const std::size_t n = model_->nominal.joints.size();
    std::array<double, kMaxJoints> q{};
    for (std::size_t i = 0; i < n; ++i) q[i] = random_.uniform(-3.2, 3.2);
    const auto seed = std::span<const double>(q).first(n);
    const Prediction prediction = corrector_->forward_model().predict(seed, context());
    hash.add(prediction.X_BT);
    for (int axis = 0; axis < 3; ++axis) hash.add(prediction.tree_B(axis));
    hash.add(static_cast<double>(prediction.status));
    if (count_++ % kCorrected != 0) return;
    for (std::size_t i = 0; i < n; ++i) q[i] += random_.uniform(-0.01, 0.01);
    add(corrector_->solve(prediction.X_BT, seed, SeedKind::kCommanded, context()), hash);
  }

  long solved() const { return solved_; }

 private:
  static constexpr int kInputsPerArm = 200;

  void renew() {
    const auto number = static_cast<std::uint64_t>(count_ / kInputsPerArm);
    format::Model model = tests::random_arm_model(kSeed + number);
    model.guard.corrects = number % 2 == 0 ? format::Corrects::kPosition : format::Corrects::kPose;
    model_ = std::make_unique<format::Model>(std::move(model));
    corrector_ = std::make_unique<Corrector>(*model_);
  }

  Context context() {
    Context out;
    for (double& x : out.direction) x = random_.below(3) - 1.0;
    for (double& x : out.travel) x = random_.uniform(0.0, 1.0);
    for (double& x : out.temperature_degC) x = random_.uniform(10.0, 40.0);
    out.payload_kg = random_.uniform(0.0, 10.0);
    out.time_s = random_.uniform(0.0, 1e4);
    return out;
  }

  void add(const Correction& correction, tests::BitHash& hash) {
    hash.add(correction.X_BC);
    for (const double q : correction.q) hash.add(q);
    hash.add(correction.residual_m);
    hash.add(correction.residual_rad);
    hash.add(static_cast<double>(correction.status));
    solved_ += refused(correction.status) ? 0 : 1;
  }

  tests::Random random_{kSeed};
  std::unique_ptr<const format::Model> model_;
  std::unique_ptr<const Corrector> corrector_;
  int count_ = 0;
  long solved_ = 0;
};

TEST(Bits, OfArmsOfEveryKindAreTheSameEverywhere) {
  ManyArms arms;
  expect_bits([&](tests::BitHash& hash) { arms(hash); }, 0x6e9030867dfb0de7U, 0x734c30341549e6e0U);
  EXPECT_GT(arms.solved(), 1000);
}

TEST(Bits, OfBlendedTreesAloneAreTheSameEverywhere) {
  const format::Model model = tests::blended_arm();
  const ForwardModel arm(model);
  tests::Random random(kSeed);
  long moved = 0, all = 0;
  const auto one_input = [&](tests::BitHash& hash) {
    std::array<double, 6> q{};
    for (double& x : q) x = random.uniform(-3.2, 3.2);
    const Vector3 error = arm.tree_error(q);
    for (int axis = 0; axis < 3; ++axis) hash.add(error(axis));
    moved += error.norm() > 1e-6 ? 1 : 0;
    ++all;
  };
  expect_bits(one_input, 0x9f6e75a3bc297a9dU, 0xf9b7506ccd7969a3U);
  EXPECT_GT(moved, all / 3);
}

}  // namespace
}  // namespace plumb
