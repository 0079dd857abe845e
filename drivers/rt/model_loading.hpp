// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "rt/deployment.hpp"

namespace plumb::drivers::rt {

/// Reads and verifies a model on a thread of its own, which may take as long as the disk does.
/// Nobody waits for that thread: if this object goes first, it ends by itself, or with the program.
class ModelLoading {
 public:
  /// As load_next_model. Throws std::system_error if there is no thread for it.
  explicit ModelLoading(NextModel next);

  bool done() const noexcept;

  /// The model; or throws what load_next_model threw. Once, and only when done.
  RunningModel result();

 private:
  struct Shared;
  std::shared_ptr<Shared> shared_;
};

}  // namespace plumb::drivers::rt
