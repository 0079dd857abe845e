// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string_view>

#include "import/imported.hpp"

namespace plumb::offline {

/// measurements.csv, a block of whole lines at a time: comments, header with units, rows.
void write_imported(const Imported& data, const std::function<void(std::string_view)>& write);

/// Throws Failure if plumb's own reader of measurements does not accept what is written.
void check_imported(const Imported& data);

}  // namespace plumb::offline
