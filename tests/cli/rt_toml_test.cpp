// SPDX-License-Identifier: Apache-2.0
// plumb-rt reads what plumb deploy writes, and it means what its own defaults mean.
#include "deploy/rt_toml.hpp"

#include <gtest/gtest.h>

#include <tuple>

#include "bus_text/layout_toml.hpp"
#include "rt/modbus_source.hpp"
#include "rt/rt_config.hpp"

namespace plumb::offline {
namespace {

using drivers::BusUse;

Cell cell_of(int joints) {
  Cell out;
  out.serial = "F08-\"1234\"";
  out.nominal.joints.resize(static_cast<std::size_t>(joints));
  for (auto& row : out.nominal.joints) row.q_min = -3.0, row.q_max = 3.0;
  return out;
}

struct Read {
  drivers::rt::RtConfig config;
  drivers::BusLayout layout;
  std::string errors;
};

Read read(const std::string& text, const Cell& cell) {
  TomlSource source("rt.toml", text, "E-RT");
  const toml::table parsed = source.parse();
  TomlTable top(parsed, "", source);
  Read out;
  out.config = drivers::rt::read_rt_config(top, "deploy");
  auto bus = top.table("bus");
  out.layout = drivers::read_bus(*bus, drivers::bus_arm(cell.nominal, cell.deploy.cycle_s),
                                 cell.deploy.link);
  top.done();
  for (const auto& problem : source.problems().errors()) out.errors += render(problem);
  return out;
}

TEST(RtToml, IsReadWithoutAWordOfComplaintForAnyArmAndLink) {
  for (int joints = 1; joints <= 9; ++joints)
    for (const auto link : {BusUse::kCan, BusUse::kModbus}) {
      Cell cell = cell_of(joints);
      cell.deploy.link = link;
      cell.deploy.interface = "vcan3";
      cell.deploy.address = "192.168.0.7";
      const Read got =
          read(write_rt_toml(cell, drivers::default_layout(joints, 0.004, 2), {}), cell);
      EXPECT_EQ(got.errors, "");
      EXPECT_EQ(got.config.serial, cell.serial);
      EXPECT_EQ(got.config.source->use(), link);
      if (link == BusUse::kCan) {
        EXPECT_EQ(got.config.source->name(), "vcan3");
      } else {
        const auto& modbus = dynamic_cast<const drivers::rt::ModbusSource&>(*got.config.source);
        EXPECT_EQ(modbus.address, "192.168.0.7");
      }
    }
}

TEST(RtToml, AnAddressMayNameItsPort) {
  Cell cell = cell_of(6);
  cell.deploy.link = BusUse::kModbus;
  for (const auto& [address, host, port] :
       {std::tuple("10.0.0.7:1502", "10.0.0.7", 1502), std::tuple("fe80::1", "fe80::1", 502)}) {
    cell.deploy.address = address;
    const Read got = read(write_rt_toml(cell, drivers::default_layout(6, 0.004), {}), cell);
    EXPECT_EQ(got.errors, "");
    const auto& modbus = dynamic_cast<const drivers::rt::ModbusSource&>(*got.config.source);
    EXPECT_EQ(modbus.address, host);
    EXPECT_EQ(modbus.port, port);
  }
}

TEST(RtToml, SaysWhatAnEmptyFileWouldMean) {
  const Cell cell = cell_of(6);
  const Read got = read(write_rt_toml(cell, drivers::default_layout(6, 0.004), {}), cell);
  const Read empty = read("schema = \"rt/1\"\n[bus]\n", cell);
  const auto& a = got.config;
  const auto& b = empty.config;
  EXPECT_EQ(a.model, b.model);
  EXPECT_EQ(a.cycle_us, b.cycle_us);
  EXPECT_EQ(a.priority, b.priority);
  EXPECT_EQ(a.cpu, b.cpu);
  EXPECT_EQ(a.give_up_s, b.give_up_s);
  EXPECT_EQ(a.source->name(), b.source->name());
  EXPECT_EQ(a.sink.kind, b.sink.kind);
  EXPECT_EQ(a.session.mode, drivers::CorrectionMode::kShadow);
  EXPECT_NEAR(a.session.target.speed_m_s, b.session.target.speed_m_s, 1e-9);
  EXPECT_NEAR(a.session.target.speed_rad_s, b.session.target.speed_rad_s, 1e-8);
  EXPECT_NEAR(a.session.target.step_m, b.session.target.step_m, 1e-12);
  EXPECT_NEAR(a.session.target.step_rad, b.session.target.step_rad, 1e-10);
  EXPECT_NEAR(a.session.share.limited_m, b.session.share.limited_m, 1e-12);
  EXPECT_NEAR(a.session.share.limited_scale, b.session.share.limited_scale, 1e-12);
  EXPECT_EQ(a.session.sync.poses, b.session.sync.poses);
  EXPECT_NEAR(a.session.sync.position_m, b.session.sync.position_m, 1e-15);
  EXPECT_NEAR(a.session.sync.rotation_rad, b.session.sync.rotation_rad, 1e-15);
  EXPECT_EQ(a.session.sync.distinct, b.session.sync.distinct);
  EXPECT_NEAR(a.session.sync.silence_s, b.session.sync.silence_s, 1e-12);
  EXPECT_NEAR(a.session.arm.distance_m, b.session.arm.distance_m, 1e-12);
  EXPECT_NEAR(a.session.arm.angle_rad, b.session.arm.angle_rad, 1e-10);
  EXPECT_NEAR(a.session.arm.lag_s, b.session.arm.lag_s, 1e-12);
  EXPECT_EQ(a.record, b.record);
  EXPECT_EQ(a.metrics_port, b.metrics_port);
}

}  // namespace
}  // namespace plumb::offline
