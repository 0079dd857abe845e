// SPDX-License-Identifier: Apache-2.0
#include "fit/likeness.hpp"

namespace plumb::offline {

const char* name_of(Likeness::Kind kind) {
  switch (kind) {
    case Likeness::Kind::kSame:
      return "same";
    case Likeness::Kind::kSister:
      return "sister";
    case Likeness::Kind::kUnlike:
      return "unlike";
    case Likeness::Kind::kUnknown:
      break;
  }
  return "unknown";
}

}  // namespace plumb::offline
