// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "effects/effect_entry.hpp"

namespace plumb::offline {

/// What a cell and its measurements say of the constants of a law that the cell file leaves open.
/// Each function looks through all poses, so it is called only where its answer is needed.
class ConstantsSource {
 public:
  struct Span {
    double first = 0.0, last = 0.0;
  };

  virtual ~ConstantsSource() = default;

  /// Largest torque on each joint over the measured poses [N m].
  virtual std::vector<double> largest_torques() const = 0;

  /// Time of the measurements [s], or their order where no time is known; nothing if neither is.
  virtual std::optional<Span> time() const = 0;

  /// Temperature columns: "temp_base".
  virtual const std::vector<std::string>& sensors() const = 0;

  /// Mean of one of them over the rows that have it [degC]; nothing if no row has it.
  virtual std::optional<double> mean_temperature(const std::string& sensor) const = 0;

  virtual bool has_direction() const = 0;

  virtual bool slides(int joint) const = 0;

  /// Smallest and largest position of a joint over the measured poses [rad] or [m].
  virtual Span travel(int joint) const = 0;
};

/// Throws Failure (kInput): "effect 'drift' WHY", at the line of the entry.
[[noreturn]] void refuse_effect(const EffectEntry& entry, const std::string& why,
                                const std::string& help);

}  // namespace plumb::offline
