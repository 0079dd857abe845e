// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "program/toml_table.hpp"
#include "rt/bus_source.hpp"

namespace plumb::drivers::rt {

/// A CAN interface of this machine.
class CanSource final : public BusSource {
 public:
  std::string interface = "can0";

  static std::shared_ptr<const BusSource> read(TomlTable& source,
                                               const std::filesystem::path& folder);
  BusUse use() const noexcept override { return BusUse::kCan; }
  std::string name() const override { return interface; }
  BusEndpoint endpoint() const override {
    return {.kind = BusEndpoint::Kind::kCan, .interface = interface};
  }

  /// Refuses an interface that cannot do what the layout asks for.
  std::unique_ptr<OpenBus> open(const BusTask& task) const override;
};

}  // namespace plumb::drivers::rt
