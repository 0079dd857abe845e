// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "effects/constants_source.hpp"
#include "effects/data_sense.hpp"
#include "effects/effect_option.hpp"
#include "effects/testability.hpp"
#include "plumb/format/model.hpp"
#include "plumb/runtime/detail/effect.hpp"

namespace plumb::offline {

/// Which joints an entry of [effects] may list.
enum class JointList {
  kNone,          // it belongs to the whole arm
  kSet,           // any of them, each once; no list means all joints that turn
  kSliding,       // joints that slide, each once; no list means all of them
  kOrderedPair,   // two: the one that moves, then the one that moves it
  kOneIfEncoder,  // the one whose encoder slipped if `of = "joint"`, otherwise none
  kInFormula,     // none: the text of the formula names them
};

/// How diagnose looks for the law.
enum class Search {
  kNever,        // another law describes the same motion, or it has too many parameters
  kGrid,         // one candidate for each joint and each point of the grid of its options
  kWaves,        // scanned over the wave number of each joint; several waves are one candidate
  kChangePoint,  // scanned over the row after which something moved
  kSeries,       // all joints at once, with a prior whose size the evidence chooses
};

/// For which joints diagnose makes candidates of a law that is searched on a grid.
enum class CandidateJoints {
  kNone,         // one candidate without joints
  kEach,         // one for every joint that turns; see also EffectDescriptor::at_slide
  kSliding,      // one for every joint that slides
  kLoadedPairs,  // one for every ordered pair whose second joint carries a load
  kSecond,       // the second joint alone
  kNeighbours,   // one for every ordered pair of neighbours whose second joint turns
};

/// How the points of a grid of one option come about.
struct GridAxis {
  enum class Values {
    kAsListed,         // `values` are values of the option
    kOfLargestTorque,  // `values` are shares of the largest torque on the joint
    kOfSession,        // `values` are shares of the time from the first to the last pose
    kSensors,          // every temperature sensor of the measurements
    kPitches,          // from the first to the second share of the joint's travel, in steps that
                       // the travel can tell apart
  };
  OptionKey key;
  Values kind = Values::kAsListed;
  std::span<const double> values = {};
  bool also_without = false;  // a candidate that does not set the option comes first
};

/// How the best value on the grid of an option is refined: multiplied and divided by a factor that
/// shrinks, up to the largest value that is still this law.
struct Refinement {
  enum class Most {
    kAsStated,         // `most` is a value of the option
    kOfLargestTorque,  // `most` is a share of the largest torque on the joint
  };
  OptionKey key;
  double factor = 1.7;
  bool of_travel = false;  // instead, the factor is what the joint's travel can tell apart
  Most kind = Most::kAsStated;
  double most = 0.0;
};

/// What differs where a law that is tried at each joint stands at one that slides: it moves by
/// metres where the others turn by radians.
struct AtSlide {
  const char* unit;  // of its parameters
  double typical;    // 1 sigma of their prior, in that unit
  // The same members as in EffectDescriptor, for a joint that slides.
  const char* sentence;
  const char* negative_sentence = nullptr;
  std::span<const GridAxis> grid = {};
  const Refinement* refinement = nullptr;
};

/// Laws of one cause describe the same motion more or less finely: what a coarse one leaves is no
/// new effect.
enum class Cause { kItsOwn, kYieldingJoint, kUnevenGear };

/// How a parameter's prior falls off beyond its width: a heavy tail lets what the poses clearly
/// show be as large as it is.
enum class PriorTail { kHeavy, kNormal };

/// Data of the cell that state the size of a parameter better than the law's typical size does.
enum class StatedSize { kNone, kJointStiffness, kLinkStiffness };

/// What of a joint may be different when the arm is measured again. It is looked for at every joint
/// where the data allow it.
struct LaterChange {
  double chance;         // before anything is measured; only ratios to other changes count
  const char* words;     // "the stiffness of {}", {} being the joint
  const char* sentence;  // {0}: the joint; {1}, {2}: its number then and now; {3}: their unit
};

/// All that the offline half knows of one entry of [effects]. The law itself, with its parameters,
/// their typical sizes and bounds, stands in runtime/include/plumb/runtime/detail/effects.
///
/// Texts and spans live as long as the program.
struct EffectDescriptor {
  std::string_view name;
  const EffectInfo* law = nullptr;  // null for geometry and local_tree, which are no laws

  const char* explanation = "";  // the paragraph of `plumb explain`

  // What a cell file may say of it.
  std::span<const EffectOption> options = {};
  JointList joints = JointList::kNone;
  const char* pair = "";  // of two joints: which is named first, and which second

  // Which data show it. Null: it is no effect that data are asked for.
  Testability (*testable)(const DataSense& data) = nullptr;
  const char* measure = "";  // what to measure if the data do not show it

  // What it is called. {0}: its joints; {1}: "s" behind a verb of one joint, nothing behind that of
  // several; {2}: the waves of a ripple in words.
  const char* sentence = "";  // empty: the title says it
  /// The same where all its numbers are below zero, if that says something else. {3}: "is" or
  /// "are". {4}, {5}: its first and last joint. {6}: its pitch in mm. {7}: are masses given?
  const char* negative_sentence = nullptr;
  /// The title of one entry, if it says more than the law's title. `joint` is the first one listed.
  std::string (*entry_title)(const EffectEntry& entry, const std::string& joint) = nullptr;

  // How diagnose looks for it.
  Search search = Search::kGrid;
  CandidateJoints candidate_joints = CandidateJoints::kNone;
  std::span<const GridAxis> grid = {};
  const Refinement* refinement = nullptr;  // null: the grid is fine enough
  const AtSlide* at_slide = nullptr;       // null: it is not tried at joints that slide
  bool turns_listed_joint_only = false;    // it moves nothing but the position of that joint
  bool once_a_joint = false;               // a joint has one of them, with one value of its options
  const OptionKey* told_apart_by = nullptr;  // entries that differ in it are different effects
  Cause cause = Cause::kItsOwn;
  StatedSize stated_size = StatedSize::kNone;
  /// Joints are put into one entry if a further one moves the measured point by at least this share
  /// of the best one; beyond 1 only if both together leave nothing but noise; 0: never.
  double group_share = 0.0;
  bool joints_apart = false;  // a joint of several can be judged and taken out alone
  std::span<const std::string_view> same_motion = {};  // laws that cannot be told from it

  /// The figure that shows it at work, if it lists no joint; otherwise that of its first joint
  /// does.
  std::string_view figure = "error-map";

  const LaterChange* later_change = nullptr;  // null: it stays as it was calibrated

  // How it is bound to a cell and its measurements, and fitted.
  /// Fills in constants and context. Throws Failure (kInput) if the data do not allow it.
  void (*bind)(const EffectEntry& entry, const ConstantsSource& source,
               format::Effect& out) = nullptr;
  double prior_width = 5.0;  // of a parameter, in typical sizes
  PriorTail prior_tail = PriorTail::kHeavy;
  /// Typical size of parameter `place` of a joint of this effect; null: that of the law.
  double (*typical)(const format::Effect& effect, int place) = nullptr;
  /// Number of parameters of one joint; null: those of the law.
  int (*parameters_of_joint)(int arm_joints, int joint) = nullptr;
  /// Parameters behind those of the joints, which belong to the arm.
  std::span<const EffectParameter> arm_parameters = {};
  /// Name of parameter `place` of a joint; null: that of the law.
  std::string (*parameter_name)(int place) = nullptr;
  /// What tells its parameters from those of another entry of that name: ".k20".
  std::string (*parameter_infix)(const format::Effect& effect) = nullptr;
};

}  // namespace plumb::offline
