// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace plumb {

/// A sentence of a result that judges, or its beginning, and its class: good, partly, bad or
/// unknown. Every medium takes its colour from the class and never from the words.
struct Verdict {
  std::string sentence, found;
};

}  // namespace plumb
