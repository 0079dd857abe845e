// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "plumb/runtime/model_slot.hpp"
#include "rt/deployment.hpp"
#include "rt/journal.hpp"
#include "rt/listener.hpp"
#include "rt/model_loading.hpp"
#include "rt/status_text.hpp"
#include "rt/swap_request.hpp"

namespace plumb::drivers::rt {

/// What a status says of the model that runs, read from `file`.
void put_model(const Deployment& deployment, const std::filesystem::path& file, RunFacts& facts);

/// The swap of the model that runs, from the request to the answer: the file is loaded on a thread
/// of its own, the model is checked against the one that runs, the ceilings and the bus, and then
/// handed to the cycle, which never waits for it. One swap at a time; a failed one changes nothing.
/// Each is a line of the journal.
///
/// Thread: one, without real-time priority.
class ModelSwap {
 public:
  /// Refers to all of these; they must outlive it.
  ModelSwap(Deployment& deployment, ModelSlot& slot, RunFacts& facts, Journal& journal);

  /// Begins to load the model that is asked for, or answers why not.
  void begin(Asked asked);

  /// Answers when the model is loaded, or when that takes too long; a model that comes later than
  /// that is not swapped in. Returns true if another model runs now.
  bool go_on();

 private:
  /// A request that is being worked on.
  struct Swap {
    Descriptor peer;  // who asked; closed once answered
    SwapRequest request;
    std::string by;  // user who asked
    ModelLoading loading;
    std::int64_t end_ns;  // when the peer is answered that it takes too long
  };
  std::string swap_loaded();
  std::string swap(const SwapRequest& request, RunningModel next);
  void end(const std::string& answer);
  void note(const std::string& file, const std::string& by, const std::string& answer);

  Deployment& deployment_;
  ModelSlot& slot_;
  RunFacts& facts_;
  Journal& journal_;
  RunningModel before_;  // kept while the cycle may still use it
  std::optional<Swap> swap_;
  bool swapped_ = false;  // in this go_on()
  std::string own_name_;  // of the user who runs plumb-rt
};

}  // namespace plumb::drivers::rt
