// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "program/toml_table.hpp"
#include "rt/bus_source.hpp"

namespace plumb::drivers::rt {

/// A file of targets, without a robot. Its messages are those of Modbus.
class CsvSource final : public BusSource {
 public:
  std::filesystem::path file;

  static std::shared_ptr<const BusSource> read(TomlTable& source,
                                               const std::filesystem::path& folder);
  BusUse use() const noexcept override { return BusUse::kModbus; }
  bool has_robot() const noexcept override { return false; }
  std::string name() const override { return "csv"; }
  std::unique_ptr<OpenBus> open(const BusTask& task) const override;
};

}  // namespace plumb::drivers::rt
