// SPDX-License-Identifier: Apache-2.0
// Checks one law of the library, which is named on the command line. adding_an_effect.py compiles
// it in a copy of the sources to which a law was added as docs/adding-an-effect.md says.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "arm/dual.hpp"
#include "effects/fitted_laws.hpp"
#include "effects/registry.hpp"
#include "plumb/runtime/forward_model.hpp"
#include "tests/random_numbers.hpp"
#include "tests/rt/every_effect.hpp"
#include "tests/rt/one_arm.hpp"

namespace plumb::offline {
namespace {

constexpr int kJoints = 6;
constexpr int kPoses = 50;

int faults = 0;

void require(bool holds, const char* what) {
  if (holds) return;
  ++faults;
  std::fprintf(stderr, "not so: %s\n", what);
}

void check_registry(std::string_view name) {
  const EffectDescriptor* found = find_descriptor(name);
  require(found != nullptr, "the registry knows the law");
  if (found == nullptr) return;
  require(found->law == &fitted_law_info(find_fitted_law(name)),
          "the descriptor is that of the law");
  require(std::string(found->explanation).size() > 60, "the law is explained");
  require(found->testable != nullptr, "the descriptor says which data show the law");
  require(effect_descriptors().size() == 2U + static_cast<std::size_t>(kFittedLaws),
          "every law of the library has a descriptor");
}

/// A heavy arm without trees that has this effect on all its joints.
format::Model arm_with(int law) {
  format::Model out = tests::one_arm();
  out.trees = {};
  tests::add_masses(out);
  out.effects = {tests::typical_effect(out, law, kJoints)};
  return out;
}

/// Displacement, turn and motion of every joint.
template <class S>
std::vector<S> numbers_of(const Motion<S>& motion) {
  std::vector<S> out;
  for (int k = 0; k < 3; ++k) out.push_back(motion.shift_B(k));
  for (int k = 0; k < 3; ++k) out.push_back(motion.turn_B(k));
  out.insert(out.end(), motion.dq.begin(), motion.dq.begin() + kJoints);
  return out;
}

/// One pose, at which the law is evaluated with any parameters.
class Pose {
 public:
  Pose(const format::Model& model, const Chain& chain, std::span<const double> q)
      : law_(find_fitted_law(model.effects[0].name)),
        shape_(effect_shape(model, model.effects[0])),
        chain_(chain),
        q_(q) {
    chain_.frames(q_, frames_);
    effect_weights(model, {}).weigh(frames_, nothing_.known, loads_);
  }

  template <class S>
  std::vector<S> motion(const std::vector<S>& theta) const {
    Motion<S> out;
    const Situation at{
        .q = q_, .chain = chain_, .frames = frames_, .loads = loads_, .context = nothing_.known};
    apply_fitted_law<S>(law_, theta, shape_, at, nothing_, out);
    return numbers_of(out);
  }

 private:
  int law_;
  EffectShape shape_;
  const Chain& chain_;
  std::span<const double> q_;
  ChainFrames frames_;
  Loads loads_;
  MeasuredContext nothing_;
};

/// The largest slope by this parameter; the exact slopes are held against finite differences.
double check_slopes(const Pose& pose, const std::vector<double>& theta, std::size_t parameter) {
  using Number = DualOf<1>;
  std::vector<Number> exact(theta.begin(), theta.end());
  exact[parameter].d(0) = 1.0;
  const double size = 1e-3 * std::abs(theta[parameter]);
  std::vector<double> less = theta, more = theta;
  less[parameter] -= size;
  more[parameter] += size;
  const auto here = pose.motion(exact);
  const auto before = pose.motion(less), behind = pose.motion(more);
  double largest = 0.0;
  for (std::size_t i = 0; i < here.size(); ++i) {
    const double slope = (behind[i] - before[i]) / (2.0 * size);
    require(std::abs(slope - here[i].d(0)) <= 1e-6 * std::abs(slope) + 1e-15 / size,
            "derivatives equal finite differences");
    largest = std::max(largest, std::abs(here[i].d(0)));
  }
  return largest;
}

/// Whether the forward model of the cycle moves the tool as the motion of the law says.
void check_cycle(const format::Model& model, const Chain& chain, const std::vector<double>& motion,
                 std::span<const double> q) {
  std::array<double, kJoints> there{};
  for (std::size_t j = 0; j < kJoints; ++j) there[j] = q[j] + motion[6 + j];
  const Vector3 expected = chain.forward(there).p + Vector3(motion[0], motion[1], motion[2]);
  const Vector3 moved = ForwardModel(model).predict(q).X_BT.p;
  require((moved - expected).norm() < 1e-12, "the cycle moves the tool as the law says");
  require((moved - chain.forward(q).p).norm() > 0.0, "the law moves the tool");
}

void check_law(int law) {
  tests::Random random(1);
  format::Model model = arm_with(law);
  require(find_effect_fault(model).kind == EffectFault::Kind::kNone, "the runtime accepts a model");
  std::vector<double>& theta = model.effects[0].parameters;
  const std::vector<double> typical = theta;
  const Chain chain(model.calibrated);
  std::vector<double> largest(theta.size(), 0.0);
  for (int pose = 0; pose < kPoses; ++pose) {
    for (std::size_t k = 0; k < theta.size(); ++k) theta[k] = typical[k] * random.uniform(0.5, 1.5);
    std::array<double, kJoints> q{};
    for (double& x : q) x = random.uniform(-3.0, 3.0);
    const Pose at(model, chain, q);
    for (std::size_t k = 0; k < theta.size(); ++k)
      largest[k] = std::max(largest[k], check_slopes(at, theta, k));
    check_cycle(model, chain, at.motion(theta), q);
  }
  for (const double slope : largest) require(slope > 0.0, "every parameter moves something");
  std::printf("%zu parameters of '%s' at %d poses\n", theta.size(), model.effects[0].name.c_str(),
              kPoses);
}

}  // namespace
}  // namespace plumb::offline

int main(int count, char** arguments) {
  using namespace plumb;
  if (count != 2) {
    std::fprintf(stderr, "usage: new_law_check LAW\n");
    return 2;
  }
  const int law = find_effect_law(arguments[1]);
  offline::require(law >= 0, "the library has the law");
  offline::check_registry(arguments[1]);
  if (law >= 0) offline::check_law(law);
  return offline::faults == 0 ? 0 : 1;
}
