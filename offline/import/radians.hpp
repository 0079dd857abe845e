// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "import/column_plan.hpp"
#include "import/content.hpp"
#include "import/imported.hpp"

namespace plumb::offline {

/// Warns of joint columns in degrees that probably hold radians: no number is larger than one
/// turn in radians, and the points moved much farther than such small angles could move them.
/// Nothing is converted.
void say_of_radians(const std::vector<ColumnPlan>& plans,
                    const std::vector<ColumnContent>& contents, Imported& data);

}  // namespace plumb::offline
