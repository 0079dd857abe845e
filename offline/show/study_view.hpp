// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "show/json.hpp"
#include "study/planar_study.hpp"
#include "study/six_axis_study.hpp"

namespace plumb::offline::show {

/// result of `study planar`.
Json planar_json(const study::PlanarStudy& study);

/// Verdict first, then every model beside the paper, then what deviates and why.
std::string planar_text(const study::PlanarStudy& study);

/// result of `study six-axis`.
Json six_axis_json(const study::SixAxisStudy& study);

std::string six_axis_text(const study::SixAxisStudy& study);

}  // namespace plumb::offline::show
