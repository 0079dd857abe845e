// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <vector>

#include "plumb/drivers/bus_port.hpp"
#include "plumb/drivers/can_codec.hpp"
#include "plumb/runtime/chain.hpp"
#include "rt/csv_targets.hpp"

namespace plumb::drivers::rt {

/// Plays targets from a file, one row a cycle, with a controller made up around them: the nominal
/// arm of the model, drives on, correction enabled. Before the rows the first one stands still
/// while the session synchronises; at the end the last one stands.
///
/// Values are those that `layout` can carry, so that a record of them loses nothing.
///
/// No allocation after the constructor; nothing is sent anywhere. Thread: one, but for finished().
class CsvPort final : public BusPort {
 public:
  /// lead: cycles that the first row stands before the others follow.
  CsvPort(std::vector<CsvTarget> rows, const Chain& nominal, std::uint32_t robot,
          const BusLayout& layout, int lead);

  bool receive(BusMessage& message) noexcept override;
  bool send(const BusMessage&) noexcept override {
    ++counters_.sent;
    return true;
  }
  LinkState state() const noexcept override { return LinkState::kUp; }
  PortCounters counters() const noexcept override { return counters_; }

  /// Every row has been played.
  bool finished() const noexcept { return finished_.load(std::memory_order_relaxed); }

 private:
  BusMessage compose(int part) const noexcept;
  bool carried(BusMessage& message) noexcept;
  void advance() noexcept;

  std::vector<CsvTarget> rows_;
  std::vector<Transformd> X_BN_;  // what the nominal arm shows for the joints of each row
  std::uint32_t robot_;
  CanCodec sent_;
  CanCodec heard_;
  int lead_;
  std::size_t row_ = 0;
  int part_ = 0;  // of the row's messages
  std::uint16_t counter_ = 0;
  std::atomic<bool> finished_{false};
  PortCounters counters_;
};

}  // namespace plumb::drivers::rt
