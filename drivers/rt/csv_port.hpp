// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <vector>

#include "plumb/drivers/bus_port.hpp"
#include "plumb/drivers/can_codec.hpp"
#include "plumb/runtime/loaded_model.hpp"
#include "rt/csv_targets.hpp"

namespace plumb::drivers::rt {

/// Plays targets from a file, one row per cycle, and simulates the controller that sends them: the
/// nominal arm of the model, drives on, correction enabled. The first row is repeated while the
/// session synchronises, the last row after the end.
///
/// All values are rounded as `layout` encodes them, so that a record of them is exact.
///
/// No allocation after the constructor; nothing is sent anywhere. Thread: one, except for
/// finished().
class CsvPort final : public BusPort {
 public:
  /// lead: number of cycles for which the first row is repeated.
  CsvPort(std::vector<CsvTarget> rows, const LoadedModel& model, std::uint32_t robot,
          const BusLayout& layout, int lead);

  bool receive(BusMessage& message) noexcept override;
  bool send(const BusMessage&) noexcept override {
    ++counters_.sent;
    return true;
  }
  LinkState state() const noexcept override { return LinkState::kUp; }
  PortCounters counters() const noexcept override { return counters_; }

  /// True if every row has been played.
  bool finished() const noexcept { return finished_.load(std::memory_order_relaxed); }

 private:
  BusMessage compose(int part) const noexcept;
  bool carried(BusMessage& message) noexcept;
  void advance() noexcept;

  std::vector<CsvTarget> rows_;
  std::vector<Transformd> X_BN_;  // tool pose of the nominal arm at the joints of each row
  std::uint32_t robot_;
  CanCodec sent_;
  CanCodec heard_;
  int lead_;
  std::size_t row_ = 0;
  int part_ = 0;  // index of the next message of the row
  std::uint16_t counter_ = 0;
  std::atomic<bool> finished_{false};
  PortCounters counters_;
};

}  // namespace plumb::drivers::rt
