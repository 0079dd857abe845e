// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/blind/score.hpp"

namespace plumb::tests {

/// All but the true fall, from what the diagnosis makes public.
Claims claims_of(const HiddenCase& drawn, const offline::Diagnosis& diagnosis);

}  // namespace plumb::tests
