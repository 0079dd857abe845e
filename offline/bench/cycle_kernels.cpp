// SPDX-License-Identifier: Apache-2.0
#include "bench/cycle_kernels.hpp"

#include <algorithm>
#include <utility>

#include "bench/part_models.hpp"

namespace plumb::offline::bench {
namespace {

template <class Call>
std::unique_ptr<Kernel> kernel_of(Call call) {
  return std::make_unique<KernelOf<Call>>(std::move(call));
}

BenchPose linked(const BenchPose& pose, double link) noexcept {
  BenchPose out = pose;
  out.q[0] += 0.0 * link;
  out.X_BD.p(0) += 0.0 * link;
  return out;
}

}  // namespace

/// The model stays where it is: all else refers to it.
struct CycleKernels::Arm {
  explicit Arm(format::Model given)
      : model(std::move(given)), corrector(model), guard(model.guard) {}

  std::span<const double> joints(const BenchPose& pose) const noexcept {
    return std::span<const double>(pose.q).first(model.nominal.joints.size());
  }
  Correction solve(const BenchPose& pose, const Context& context) const noexcept {
    return corrector.solve(pose.X_BD, joints(pose), SeedKind::kCommanded, context);
  }
  double guarded(const BenchPose& pose, const Correction& correction) noexcept {
    return guard.step(pose.X_BD, correction, model.guard.cycle_s).X_BC.p(0);
  }

  format::Model model;
  Corrector corrector;
  Guard guard;
};

CycleKernels::CycleKernels(const format::Model& model, const BenchInputs& inputs)
    : inputs_(inputs), cycle_(std::make_unique<WholeCycle>(model)) {
  Arm& whole = add_arm(model);
  add_correction(whole);
  add_prediction(whole, Part::kPredict);
  add_prediction(add_arm(chain_alone(model)), Part::kKinematics);
  for (std::size_t i = 0; i < model.effects.size(); ++i)
    add_prediction(add_arm(with_one_effect(model, i)), Part::kEffect,
                   unique(effect_label(model, i)));
  const bool leaves = std::any_of(model.trees.begin(), model.trees.end(),
                                  [](const auto& tree) { return tree.leaves() > 0; });
  if (leaves) add_prediction(add_arm(with_trees_alone(model)), Part::kTrees);
}

CycleKernels::~CycleKernels() = default;

CycleKernels::Arm& CycleKernels::add_arm(format::Model model) {
  arms_.push_back(std::make_unique<Arm>(std::move(model)));
  return *arms_.back();
}

void CycleKernels::add_correction(Arm& arm) {
  for (std::size_t i = 0; i < BenchInputs::kPoses; ++i) {
    corrections_.push_back(arm.solve(inputs_.pose(i), inputs_.context(i)));
    refused_ += refused(corrections_.back().status) ? 1 : 0;
  }
  kernels_.push_back({Part::kCycle, "", kernel_of([this](std::size_t i, double link) {
                        const BenchPose pose = linked(inputs_.pose(i), link);
                        return cycle_->step(pose, inputs_.context(i)).X_BC.p(0);
                      })});
  kernels_.push_back({Part::kCorrect, "", kernel_of([this, &arm](std::size_t i, double link) {
                        const BenchPose pose = linked(inputs_.pose(i), link);
                        return arm.solve(pose, inputs_.context(i)).X_BC.p(0);
                      })});
  kernels_.push_back({Part::kGuard, "", kernel_of([this, &arm](std::size_t i, double link) {
                        const BenchPose pose = linked(inputs_.pose(i), link);
                        return arm.guarded(pose, corrections_[i % BenchInputs::kPoses]);
                      })});
}

void CycleKernels::add_prediction(Arm& arm, Part part, std::string label) {
  kernels_.push_back({part, std::move(label), kernel_of([this, &arm](std::size_t i, double link) {
                        const BenchPose pose = linked(inputs_.pose(i), link);
                        return arm.corrector.forward_model()
                            .predict(arm.joints(pose), inputs_.context(i))
                            .X_BT.p(0);
                      })});
}

/// The label, with a number behind it if the model has several effects of that label.
std::string CycleKernels::unique(const std::string& label) const {
  const auto taken = std::count_if(kernels_.begin(), kernels_.end(), [&](const auto& other) {
    return other.label == label || other.label.starts_with(label + "#");
  });
  return taken == 0 ? label : label + "#" + std::to_string(taken + 1);
}

const char* name_of(Part part) {
  switch (part) {
    case Part::kCycle:
      return "cycle";
    case Part::kCorrect:
      return "correct";
    case Part::kGuard:
      return "guard";
    case Part::kPredict:
      return "predict";
    case Part::kKinematics:
      return "kinematics";
    case Part::kEffect:
      return "effect";
    case Part::kTrees:
      break;
  }
  return "trees";
}

}  // namespace plumb::offline::bench
