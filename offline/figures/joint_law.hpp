// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "arm/fitted_effects.hpp"
#include "figures/run_results.hpp"
#include "plumb/runtime/chain.hpp"

namespace plumb::offline::figures {

/// What the effects of a run add to the position of one joint, and how sure that is. Refers to the
/// results.
class JointLaw {
 public:
  /// kOwnPosition: effects by which this joint moves as a function of its own position and of the
  /// side from which it came, whatever the other joints do. kLoad: those that grow with the load
  /// on it.
  enum class Of { kOwnPosition, kLoad };

  /// Cost: effects * parameters of the run.
  JointLaw(const RunResults& results, int joint, Of of);

  bool empty() const { return terms_.empty(); }

  /// "gear ripple (12 waves) and reversal": the plain names of the effects.
  std::string names() const;

  /// [rad] or [m]; sigma: 1 sigma by the covariance of the run.
  struct Value {
    double value = 0.0, sigma = 0.0;
  };

  /// At a measured pose. Cost: an evaluation of the effects; with sigma, one for each parameter.
  double at_pose(int row) const;
  Value with_sigma(int row) const;

  /// The value at this position of the joint, reached from this side (-1, +1, 0 unknown). For
  /// kOwnPosition only.
  Value at(double q, int side) const;

  /// Whether it depends on the side from which the joint came.
  bool has_sides() const;

 private:
  struct Number {
    std::size_t place = 0;    // among the parameters of the effect
    Eigen::Index column = 0;  // of the covariance
    double step = 0.0;        // of a difference
  };
  struct Term {
    int effect = 0;
    std::vector<Number> numbers;
  };
  struct EvaluatedPose {
    std::vector<double> q;
    MeasuredContext context;
    ChainFrames frames;
    FittedEffects::Surroundings around;
  };
  void put(int row, EvaluatedPose& out) const;
  void survey(EvaluatedPose& out) const;
  double moved(int effect, const std::vector<double>& theta, const EvaluatedPose& at) const;
  double moved(int effect, const EvaluatedPose& at) const;
  bool is_own(int effect, const std::vector<EvaluatedPose>& probes) const;
  void add_numbers(Term& term, const std::vector<EvaluatedPose>& probes) const;
  double value(const EvaluatedPose& at) const;
  double sigma(const EvaluatedPose& at) const;

  const RunResults& results_;
  const format::Model& arm_;
  int joint_;
  Chain chain_;
  FittedEffects effects_;
  std::vector<std::string> sensors_;
  std::vector<std::optional<Parameter>> numbers_;  // of the covariance
  std::vector<Transformd> X_MB_;
  std::vector<Term> terms_;
  EvaluatedPose middle_;  // a pose in the middle of the measured ones
};

}  // namespace plumb::offline::figures
