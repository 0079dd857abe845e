// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace plumb::offline {

/// Whether some data can show an effect, and why.
struct Testability {
  enum class Answer { kNo, kWeakly, kYes } answer = Answer::kYes;
  std::string why;
};

}  // namespace plumb::offline
