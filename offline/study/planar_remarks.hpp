// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace plumb::offline::study {

struct PlanarStudy;

/// Sentences for the user: what deviates from the paper and why, and what the figures show.
std::vector<std::string> planar_remarks(const PlanarStudy& study);

}  // namespace plumb::offline::study
