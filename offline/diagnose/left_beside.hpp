// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/diagnosis.hpp"

namespace plumb::offline {

/// Why an effect that was added may be a part of a cause that the library does not have: as long as
/// that is not in the model, the nearest law imitates some of it.
enum class PartOf {
  kNothing,
  kLargerRest,     // more of the error is left at the end than it took away
  kRestOfItsJoint  // unknown structure that is no slow motion is left at a joint where it acts
};

/// Of one of diagnosis.added, once the diagnosis is complete but for its words.
PartOf part_of(const Diagnosis& diagnosis, const Addition& added);

/// The same of the first candidate; of one that was not added, nothing.
PartOf part_of_first(const Diagnosis& diagnosis);

}  // namespace plumb::offline
