// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace plumb::offline::cli {

/// "3", "0003" or "runs/0003". Throws Failure (kUsage).
int run_number(const std::string& text);

}  // namespace plumb::offline::cli
