// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace plumb::offline {

/// What a diagnosis comes to.
enum class Finding {
  kComplete,    // nothing more is supported
  kMissing,     // an effect of the library is
  kUnknown,     // structure that none of them explains
  kUndecidable  // too few poses, no noise floor, an exact tie, a law or a slow motion that they
                // cannot show, or far more than the noise is left and nothing says of what kind
};

constexpr const char* name_of(Finding finding) {
  switch (finding) {
    case Finding::kMissing:
      return "missing";
    case Finding::kUnknown:
      return "unknown";
    case Finding::kUndecidable:
      return "undecidable";
    default:
      return "complete";
  }
}

/// What was found out of a model and its readings, before the selection or after it; the finding
/// follows from these facts alone.
struct Facts {
  bool judgeable = true;       // the readings leave enough free lines to judge an effect by
  bool wrong_gravity = false;  // the model was fitted under a gravity that is certainly wrong
  bool structure = false;      // a pattern is supported that no law of the library explains
  bool law = false;            // a law of the library is supported, and not in the model
  // What makes a law doubtful, whether it is in the model or not.
  bool law_not_shown = false;  // it may be a law that these readings cannot show
  bool slow_motion = false;    // a step may be a slow motion
  bool tied = false;           // another law explains the readings exactly as well
  bool other_fate = false;     // it may be one that would be compiled where this one is not
  // What makes doubtful whether a law is missing, and nothing else.
  bool other_gravity = false;  // gravity that acts in another direction may be what is seen
  bool refused = false;        // chosen anew without each fold it does not predict that better
  // What is left.
  bool noise_known = true;
  bool excess = false;  // it is far above the noise floor
};

/// Exactly one finding for whatever is known.
Finding decide(const Facts& facts);

}  // namespace plumb::offline
