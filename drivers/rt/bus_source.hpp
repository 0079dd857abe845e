// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "plumb/drivers/bus_layout.hpp"
#include "plumb/drivers/bus_port.hpp"
#include "program/toml_table.hpp"

namespace plumb::drivers::rt {

struct Deployment;

/// A bus that is open, with whatever stands behind its port.
class OpenBus {
 public:
  virtual ~OpenBus() = default;
  virtual BusPort& port() noexcept = 0;

  /// Now and then, by a thread that may wait: helps a link that is down to come back.
  virtual void tend() noexcept {}

  /// There will be no further target.
  virtual bool finished() const noexcept { return false; }
};

/// What [source] of rt.toml names: where desired targets come from, and, but for a file, where the
/// answers go.
class BusSource {
 public:
  virtual ~BusSource() = default;

  /// Which layout of [bus] it needs.
  virtual BusUse use() const noexcept = 0;

  /// As the record names it: "can0", "modbus", "csv".
  virtual std::string name() const = 0;

  /// Throws Failure: E-RT-LINK (kEnvironment) with the system's reason, E-RT-CSV (kInput). Nothing
  /// is sent yet. Slow.
  virtual std::unique_ptr<OpenBus> open(const Deployment& deployment) const = 0;
};

/// One kind of bus. Another one is one more entry of bus_kinds().
struct BusKind {
  const char* word;  // kind = "can"

  /// Reads the keys of [source] besides `kind`; files are relative to the folder. Problems go to
  /// the table's source.
  std::shared_ptr<const BusSource> (*read)(TomlTable& source, const std::filesystem::path& folder);
};

/// All of them, in the order in which messages name them.
std::span<const BusKind> bus_kinds();

}  // namespace plumb::drivers::rt
