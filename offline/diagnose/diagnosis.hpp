// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "check/effect_rules.hpp"
#include "diagnose/finding.hpp"
#include "diagnose/formula_offer.hpp"
#include "diagnose/move.hpp"
#include "diagnose/regressor.hpp"
#include "fit/held_out_excess.hpp"
#include "noise/error_stats.hpp"
#include "noise/noise_floor.hpp"
#include "noise/orientation_floor.hpp"
#include "noise/repeatability.hpp"

namespace plumb::offline {

/// A fitted number of a candidate. SI.
struct CandidateNumber {
  std::string name, unit;
  double value = 0.0, std = 0.0;
  double typical = 0.0;  // 0: the arm decides
  bool plausible = true;
};

/// An effect at a joint, and what speaks for it. Errors in [m].
struct Candidate {
  EffectEntry entry;
  std::string title;   // "gear ripple"
  std::string domain;  // "robot"
  double ln_bayes = 0.0;
  double gain = 0.0, gain_se = 0.0;  // share of the RMS, K-fold inside the fit poses
  ErrorStats alone;                  // held out, with this effect
  ErrorStats alone_turns = {};       // of orientations [rad]; n = 0 where none are fitted
  ErrorStats after;                  // with the best one and this one
  std::vector<double> cycles;
  std::string peaks = {};        // of a series of waves: its largest ones in words
  std::vector<Move> moves = {};  // of a part that moved several times: all of them, in order
  bool supported = false;
  bool plausible = true;
  std::vector<CandidateNumber> numbers;
  double explained = 0.0;                    // share of what the model leaves
  double absorbed = 0.0;                     // share of its motion that the model imitates
  double largest_m = 0.0;                    // largest motion that the model cannot imitate
  std::vector<std::string> confounded_with;  // "gear_harmonics:J2"
  std::string separate;                      // the measurement that tells them apart
};

/// An effect that these poses cannot tell from another one: it explains them nearly as well, and
/// each of the two can imitate the other.
struct Alternative {
  EffectEntry entry;
  std::vector<double> cycles;  // of a ripple: all its waves
  std::string domain;          // "robot"
  double behind_nats = 0.0;    // ln B of the other one less its own; below 0: it explains more
  bool compiled = true;        // whether an effect of its domain becomes part of the model file
  std::string not_shown;       // why these data cannot show it; empty: it was searched for
  std::string measure;         // what would show it
};

/// An added effect, at one joint, of a size that hardly any arm has.
struct Oversized {
  EffectEntry entry;
  double times = 0.0;    // its size over the usual one; 0: there is no usual size
  bool possible = true;  // false: its law rules out that sign or size
};

struct UnknownStructure {
  Pattern pattern;
  double share = 0.0;    // of what the model leaves
  double rms_m = 0.0;    // motion of the measured point
  double rms_rad = 0.0;  // of the joint; 0: no joint
  /// The effect of the library that would explain it, were its size not what it is.
  std::optional<Oversized> instead;
  std::vector<Alternative> alternatives;  // laws that these data cannot show, which may explain it
};

struct Addition {
  EffectEntry entry;
  std::vector<double> cycles;  // of a ripple: all its waves
  std::string peaks;           // of a series of waves: its largest ones in words
  double ln_bayes = 0.0;
  ErrorStats held;
  std::vector<Alternative> alternatives;  // what it may be instead; all of its fate
  std::vector<Move> moves = {};           // of a part that moved several times
  ErrorStats turns = {};                  // held out, of orientations [rad]
  std::string sizes = {};                 // of a series of all joints: the error of each in words
};

/// Gravity in another direction than the cell states, under which the loads explain these poses
/// better. Base frame [m/s^2].
struct OtherGravity {
  std::array<double, 3> stated{}, found{};
  double nats_ahead = 0.0;  // of the best explanation under the stated one; two angles are paid for
  bool certain = false;     // 10 nats ahead; else these poses cannot tell
};

/// A supported effect that is not added: it has alternatives, some of which would be compiled and
/// some not, or it is a step that may be a slow motion. Adding any would decide what the compiled
/// arm is, so none is added; what was found beside them is.
struct Undecided {
  EffectEntry entry;
  std::vector<double> cycles;
  std::string domain;
  std::vector<Alternative> alternatives;
  std::optional<UnknownStructure> slow_motion =
      {};  // as in Diagnosis; then there are no alternatives
};

/// What a diagnosis finds of measured orientations, where the fit uses them.
struct FoundTurns {
  OrientationFloor floor;
  ErrorStats before, after;             // held out [rad]
  ErrorStats refused;                   // beside Diagnosis::refused
  std::optional<HeldOutExcess> excess;  // at the end
};

struct Diagnosis {
  Finding finding = Finding::kComplete;
  std::optional<Finding> finding_after;  // with `apply`
  std::string text, text_after;          // the verdicts in words
  NoiseFloor floor;             // with the repeatability of the arm in it, where it is known
  Repeatability repeatability;  // beside the first candidate; with `apply`, at the end
  int poses_fit = 0, poses_held = 0;
  int poses_choosing = 0;  // of those that are fitted: they chose the effects
  bool nested = false;     // held-out figures come from folds around the whole diagnosis
  int folds = 0;           // of the held-out figures; 0: one held-out set
  ErrorStats before, after;
  std::optional<FoundTurns> turns;
  std::vector<Addition> added;
  std::optional<EffectEntry> tied;  // explains these poses exactly as well as the first candidate
  /// What the first candidate may be instead: within 10 nats of it, and mutually confounded with
  /// it.
  std::vector<Alternative> alternatives;
  /// What the first candidate, a step, may be instead: a part that moves slowly, as no law of the
  /// library describes.
  std::optional<UnknownStructure> slow_motion;
  /// Gravity acts in another direction, or may do so. Where it is certain, `candidates` are those
  /// under it, and nothing is added before the cell says so.
  std::optional<OtherGravity> gravity;
  std::optional<Undecided> undecided;  // with `apply`: supported, and in no model
  /// With `apply`, where all was refused that the fitted poses speak for: the error on unseen poses
  /// of effects chosen anew without each fold.
  std::optional<ErrorStats> refused;
  bool full = false;                  // more would be supported, but a model holds no more effects
  std::vector<Candidate> candidates;  // by ln B
  std::vector<Testable> not_testable;
  std::optional<UnknownStructure> unknown;        // at the start
  std::optional<UnknownStructure> unknown_after;  // at the end
  std::vector<FormulaOffer> formulas;             // laws for it that fit, best first
  std::vector<Oversized> unlikely;                // added and well founded, but large
  std::optional<HeldOutExcess> held_out_excess;   // at the end; none without a noise floor
  std::vector<EffectEntry> effects;               // the list at the end
  std::vector<std::string> outliers;              // poses left out
  std::vector<Problem> remarks;                   // what could not be judged
  double regressors = 0.0;                        // tried in one look
};

struct DiagnosisRequest {
  bool apply = false;
  std::function<void(const std::string&)> tell;  // progress
};

/// Finds missing physical effects. The selection uses the fit poses alone, of more than 3,000 an
/// even choice, and the numbers of what it chose are fitted to all of them; the held-out poses are
/// used once, for the reported errors. With folds and fewer than 60 poses, or fewer than 300 where
/// waves were added, these come from cross-validation of the whole diagnosis; with more poses the
/// effects are chosen once, by the evidence of all of them, and each fold is predicted by numbers
/// fitted without it. Throws as `calibrate`.
Diagnosis diagnose(const Cell& cell, const MeasurementFiles& measured,
                   const DiagnosisRequest& request);

}  // namespace plumb::offline
