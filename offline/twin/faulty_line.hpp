// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <string_view>

#include "simulate/random.hpp"
#include "twin/fault.hpp"

namespace plumb::offline::twin {

/// One direction of a line that loses, delays, repeats, corrupts and reorders the units that it
/// transmits. The same seed has the same effect on the same traffic.
template <class Unit>
class FaultyLine {
 public:
  /// Applies a flipped bit to a unit. Returns false if the unit is lost because of it.
  using Corrupt = std::function<bool(Unit&, sim::Random&)>;

  FaultyLine(const FaultPlan& plan, std::uint64_t seed, std::string_view direction, Corrupt corrupt)
      : plan_(plan), random_(seed, direction), corrupt_(std::move(corrupt)) {}

  void put(Unit unit, std::int64_t now_ns, double path_s) {
    const auto happens = [&](FaultKind kind) {
      return plan_.active(kind, path_s) && random_.uniform() < plan_.size(kind, path_s);
    };
    if (plan_.active(FaultKind::kDisconnect, path_s) || happens(FaultKind::kLose)) return;
    if (happens(FaultKind::kCorrupt) && !corrupt_(unit, random_)) return;
    std::int64_t due_ns = now_ns + ns(plan_.size(FaultKind::kLate, path_s));
    if (happens(FaultKind::kReorder)) due_ns += ns(random_.uniform(0.0, kLongestDetour_s));
    insert({due_ns, unit});
    if (happens(FaultKind::kRepeat)) insert({due_ns, unit});
  }

  /// Takes the next unit that is due. Returns false if there is none.
  bool get(Unit& out, std::int64_t now_ns) {
    if (under_way_.empty() || under_way_.front().due_ns > now_ns) return false;
    out = under_way_.front().unit;
    under_way_.pop_front();
    return true;
  }

  void clear() { under_way_.clear(); }

 private:
  static constexpr double kLongestDetour_s = 0.012;  // delay of a message that others overtake
  struct UnderWay {
    std::int64_t due_ns;
    Unit unit;
  };

  static std::int64_t ns(double seconds) { return static_cast<std::int64_t>(seconds * 1e9); }

  void insert(UnderWay item) {
    auto at = under_way_.end();
    while (at != under_way_.begin() && std::prev(at)->due_ns > item.due_ns) --at;
    under_way_.insert(at, std::move(item));
  }

  const FaultPlan& plan_;
  sim::Random random_;
  Corrupt corrupt_;
  std::deque<UnderWay> under_way_;
};

}  // namespace plumb::offline::twin
