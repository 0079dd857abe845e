// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "plumb/drivers/session.hpp"
#include "program/toml_table.hpp"

namespace plumb::drivers::rt {

/// Where desired targets come from, and, but for a file, where the answers go.
struct SourceConfig {
  enum class Kind : std::uint8_t { kCan, kModbus, kCsv } kind = Kind::kCan;
  enum class Role : std::uint8_t { kClient, kServer } role = Role::kClient;  // ours
  std::string interface = "can0";     // CAN; Modbus server: a network interface to listen on
  std::string address = "127.0.0.1";  // Modbus TCP: of the controller, or to listen on
  int port = 502;
  int unit = 1;
  std::vector<std::string> peers = {};  // Modbus server: addresses that may connect
  std::string device = {};              // Modbus RTU; empty: TCP
  int baud = 115200;
  std::filesystem::path file = {};  // CSV
};

struct SinkConfig {
  enum class Kind : std::uint8_t { kSame, kCsv } kind = Kind::kSame;
  std::filesystem::path file = {};
};

/// rt.toml as read: what `plumb deploy` wrote, every key of it with a default. Paths are relative
/// to its folder. The layout of [bus] is read where the model is known (deployment.hpp).
struct RtConfig {
  std::filesystem::path model = "robot.plumb";
  std::string serial;  // of the robot; empty: whatever the model says
  int cycle_us = 4000;
  int priority = 80;       // SCHED_FIFO; 0: an ordinary thread
  int cpu = -1;            // -1: any
  double give_up_s = 0.0;  // end with exit code 6 when the bus is down for so long; 0: never
  SourceConfig source = {};
  SinkConfig sink = {};
  SessionSettings session = {};
  std::filesystem::path record = {};  // empty: none
  int record_max_mb = 1000;           // where the record ends [1e6 bytes]; 0: nowhere
  int metrics_port = 0;               // on 127.0.0.1; 0: none
};

/// Reads every table but [bus]; problems go to the tables' source.
RtConfig read_rt_config(TomlTable& top, const std::filesystem::path& folder);

}  // namespace plumb::drivers::rt
