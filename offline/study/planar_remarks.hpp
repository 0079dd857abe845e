// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "study/study_row.hpp"

namespace plumb::offline::study {

/// Sentences for the user: what deviates from the paper and why, and what the figures show.
std::vector<std::string> planar_remarks(PlanarVariant variant, const std::vector<StudyRow>& rows);

}  // namespace plumb::offline::study
