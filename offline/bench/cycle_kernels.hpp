// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/bench_inputs.hpp"
#include "bench/kernel.hpp"
#include "bench/whole_cycle.hpp"

namespace plumb::offline::bench {

/// The part of the cycle that is timed.
enum class Part {
  kCycle,       // Cycle::step: takes inputs, updates their ages, corrects, guards
  kCorrect,     // Corrector::solve
  kGuard,       // Guard::step
  kPredict,     // ForwardModel::predict
  kKinematics,  // predict without effects and trees
  kEffect,      // predict with one effect and no tree
  kTrees,       // predict with the trees and no effect
};

/// "cycle", "correct", ...: as programs read it.
const char* name_of(Part part);

struct CycleKernel {
  Part part = Part::kCycle;
  std::string label;  // of an effect: "joint_compliance:J2+J3", unique; else empty
  std::unique_ptr<Kernel> kernel;
};

/// The runtime's own code on a model and on its parts. Inputs are handed over by copy, a few ns.
class CycleKernels {
 public:
  /// Precondition: find_effect_fault finds none in the model.
  CycleKernels(const format::Model& model, const BenchInputs& inputs);
  ~CycleKernels();
  CycleKernels(const CycleKernels&) = delete;
  CycleKernels& operator=(const CycleKernels&) = delete;

  const std::vector<CycleKernel>& all() const { return kernels_; }

  /// The number of input poses that the corrector refuses. They take as long as the others.
  std::size_t refused_poses() const { return refused_; }

 private:
  struct Arm;

  Arm& add_arm(format::Model model);
  void add_correction(Arm& arm);
  void add_prediction(Arm& arm, Part part, std::string label = "");
  std::string unique(const std::string& label) const;

  const BenchInputs& inputs_;
  std::vector<std::unique_ptr<Arm>> arms_;
  std::unique_ptr<WholeCycle> cycle_;
  std::vector<Correction> corrections_;  // of each pose
  std::size_t refused_ = 0;
  std::vector<CycleKernel> kernels_;
};

}  // namespace plumb::offline::bench
