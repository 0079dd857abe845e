// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "plumb/drivers/session.hpp"
#include "program/toml_table.hpp"
#include "rt/bus_source.hpp"
#include "rt/ceilings.hpp"
#include "rt/record_settings.hpp"

namespace plumb::drivers::rt {

struct SinkConfig {
  enum class Kind : std::uint8_t { kSame, kCsv } kind = Kind::kSame;
  std::filesystem::path file = {};
};

/// The content of rt.toml, which `plumb deploy` writes. Every key has a default. Paths are relative
/// to its folder. [bus] is read later, when the model is known (deployment.hpp).
struct RtConfig {
  std::filesystem::path model = "robot.plumb";
  std::string serial;  // of the robot; empty: that of the model
  std::string made;  // when plumb deploy made the folder, UTC; empty: not known, before all others
  int cycle_us = 4000;
  int priority = 80;       // SCHED_FIFO; 0: an ordinary thread
  int cpu = -1;            // -1: any
  double give_up_s = 0.0;  // end with exit code 6 when the bus is down for so long; 0: never
  std::shared_ptr<const BusSource> source;  // never null once read
  SinkConfig sink = {};
  SessionSettings session = {};
  Ceilings ceilings = {};
  RecordSettings record = {};
  std::filesystem::path events = {};  // journal; empty: where journal_file() puts it
  int metrics_port = 0;               // on 127.0.0.1; 0: none
};

/// Reads every table except [bus]; problems are reported to the tables' source. `written`: the
/// folder to which the names of files that plumb-rt writes are relative; empty: `folder`.
RtConfig read_rt_config(TomlTable& top, const std::filesystem::path& folder,
                        const std::filesystem::path& written = {});

/// The files that plumb-rt writes by this configuration; some are empty.
std::vector<std::filesystem::path> written_files(const RtConfig& config);

}  // namespace plumb::drivers::rt
