// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "rt/deployment.hpp"

namespace plumb::drivers::rt {

/// Reads and verifies a model on a thread of its own, which may take as long as the disk does.
/// Nobody waits for that thread: if this object goes first, it ends by itself, or with the program.
class ModelLoading {
 public:
  /// Begins to load; `next`: the argument of load_next_model. Throws std::system_error if no thread
  /// can be started.
  explicit ModelLoading(NextModel next);

  bool done() const noexcept;

  /// Returns the model or throws what load_next_model threw. To be called once, when done() is
  /// true.
  RunningModel result();

 private:
  struct Shared;
  std::shared_ptr<Shared> shared_;
};

}  // namespace plumb::drivers::rt
