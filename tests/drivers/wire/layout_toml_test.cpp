// SPDX-License-Identifier: Apache-2.0
#include "bus_text/layout_toml.hpp"

#include <gtest/gtest.h>

#include "bus_text/reach.hpp"
#include "plumb/drivers/sensor_places.hpp"

namespace plumb::drivers {
namespace {

BusArm six_axes() {
  return {.joints = std::vector(6, format::JointType::kRevolute), .cycle_s = 0.004};
}

struct Read {
  BusLayout layout;
  std::vector<std::string> errors;  // "E-RT-KEY 3:1"
};

Read read(const std::string& text, const BusArm& arm = six_axes(), BusUse use = BusUse::kCan) {
  TomlSource source("rt.toml", text, "E-RT");
  const toml::table parsed = source.parse();
  TomlTable root(parsed, "", source);
  Read out;
  auto bus = root.table("bus");
  out.layout = read_bus(*bus, arm, use);
  for (const Problem& problem : source.problems().errors())
    out.errors.push_back(problem.code + " " + std::to_string(problem.place->line) + ":" +
                         std::to_string(problem.place->column));
  return out;
}

using Errors = std::vector<std::string>;

void expect_equal(const BusLayout& a, const BusLayout& b) {
  EXPECT_EQ(a.can_format, b.can_format);
  EXPECT_EQ(a.id_kind, b.id_kind);
  EXPECT_EQ(a.byte_order, b.byte_order);
  EXPECT_EQ(a.word_order, b.word_order);
  EXPECT_EQ(a.correction, b.correction);
  EXPECT_EQ(a.bit_rate, b.bit_rate);
  EXPECT_EQ(a.data_bit_rate, b.data_bit_rate);
  EXPECT_EQ(a.owner_register, b.owner_register);
  ASSERT_EQ(a.messages.size(), b.messages.size());
  for (const MessageLayout& m : a.messages) {
    const MessageLayout* other = b.find(m.kind);
    ASSERT_NE(other, nullptr) << m.name;
    EXPECT_EQ(m.name, other->name);
    EXPECT_EQ(m.sender, other->sender);
    EXPECT_EQ(m.can_id, other->can_id);
    EXPECT_EQ(m.first_register, other->first_register);
    EXPECT_NEAR(m.period_s, other->period_s, 1e-12);
    ASSERT_EQ(m.signals.size(), other->signals.size()) << m.name;
    for (std::size_t i = 0; i < m.signals.size(); ++i) {
      EXPECT_EQ(m.signals[i].name, other->signals[i].name);
      EXPECT_EQ(m.signals[i].unit, other->signals[i].unit);
      EXPECT_NEAR(m.signals[i].scale, other->signals[i].scale, 1e-9 * m.signals[i].scale);
    }
  }
}

TEST(LayoutToml, AnEmptyTableIsTheDefaultLayout) {
  const Read got = read("[bus]\n");
  EXPECT_EQ(got.errors, Errors{});
  expect_equal(got.layout, default_layout(6, 0.004));
}

TEST(LayoutToml, WhatIsWrittenReadsBackTheSame) {
  for (int joints = 1; joints <= 9; ++joints)
    for (const auto form : {CorrectionForm::kPose, CorrectionForm::kOffset}) {
      BusArm arm{
          .joints = std::vector(static_cast<std::size_t>(joints), format::JointType::kRevolute),
          .cycle_s = 0.004};
      arm.joints.back() = format::JointType::kPrismatic;
      BusLayout layout = arm_layout(arm, joints - 1, form);
      if (joints == 4) layout.owner_register.reset();
      if (joints == 5) layout.owner_register = 3000;
      if (joints == 3) name_temperatures({"temp_elbow", "temp"}, layout);
      layout.can_format = CanFrame::Format::kFd;
      layout.id_kind = CanFrame::Id::kExtended;
      layout.byte_order = ByteOrder::kBig;
      layout.word_order = ByteOrder::kLittle;
      layout.bit_rate = 500e3;
      layout.data_bit_rate = 2e6;
      for (MessageLayout& m : layout.messages) {
        m.can_id += 0x10000;
        m.first_register = static_cast<std::uint16_t>(m.first_register + 100);
        m.period_s *= 2;
        for (Signal& signal : m.signals)
          if (signal.unit == "um" || signal.unit == "urad") signal.scale *= 2.5;
      }
      const Read got = read(write_bus(layout, "bus"), arm);
      EXPECT_EQ(got.errors, Errors{}) << write_bus(layout, "bus");
      expect_equal(got.layout, layout);
    }
}

TEST(LayoutToml, EveryKeyDoesWhatItSays) {
  const Read got = read(R"([bus]
can_format = "fd"
id_kind = "extended"
byte_order = "big"
word_order = "little"
correction = "offset"
owner_register = 5000
bit_rate = 500000
data_bit_rate = 2000000
temperatures = 2
[bus.target]
can_id = 0x12345
register = 4000
period_us = 8000
count_um = 10
count_urad = 5
[bus.offset]
count_um = 0.5
[bus.commanded]
)");
  EXPECT_EQ(got.errors, Errors{});
  EXPECT_EQ(got.layout.can_format, CanFrame::Format::kFd);
  EXPECT_EQ(got.layout.id_kind, CanFrame::Id::kExtended);
  EXPECT_EQ(got.layout.byte_order, ByteOrder::kBig);
  EXPECT_EQ(got.layout.word_order, ByteOrder::kLittle);
  EXPECT_EQ(got.layout.correction, CorrectionForm::kOffset);
  EXPECT_EQ(got.layout.owner_register, 5000);
  EXPECT_EQ(got.layout.bit_rate, 500e3);
  EXPECT_EQ(got.layout.data_bit_rate, 2e6);
  const MessageLayout& target = *got.layout.find(MessageKind::kTarget);
  EXPECT_EQ(target.can_id, 0x12345U);
  EXPECT_EQ(target.first_register, 4000);
  EXPECT_NEAR(target.period_s, 0.008, 1e-15);
  EXPECT_NEAR(target.signals[0].scale, 1e-5, 1e-18);
  EXPECT_NEAR(target.signals[3].scale, 5e-6, 1e-18);
  EXPECT_NEAR(got.layout.find(MessageKind::kOffset)->signals[0].scale, 5e-7, 1e-18);
  EXPECT_EQ(got.layout.find(MessageKind::kContext)->signals.size(), 7U);
  EXPECT_NE(got.layout.find(MessageKind::kCommanded), nullptr);
  EXPECT_EQ(got.layout.find(MessageKind::kCorrected), nullptr);
}

TEST(LayoutToml, BadTablesAreRefusedAtTheirPlace) {
  const struct {
    const char* text;
    Errors errors;
  } kCases[] = {
      {"[bus]\ncan_formt = \"fd\"", {"E-RT-KEY 2:1"}},
      {"[bus]\ncan_format = \"FD\"", {"E-RT-RANGE 2:14"}},
      {"[bus]\nbit_rate = \"1M\"", {"E-RT-TYPE 2:12"}},
      {"[bus]\nbit_rate = 0", {"E-RT-BUS 2:12"}},
      {"[bus]\nowner_register = 65536", {"E-RT-RANGE 2:18"}},
      {"[bus]\nowner_register = 1200", {}},  // of no use on CAN
      {"[bus]\ntemperatures = 9", {"E-RT-RANGE 2:16"}},
      {"[bus]\ntemperatures = 1.5", {"E-RT-RANGE 2:16"}},
      {"[bus]\ntemperatures = [\"temp\", 3]", {"E-RT-TYPE 2:25"}},
      {"[bus]\ntemperatures = [\"t1\"]", {"E-RT-RANGE 2:17"}},
      {"[bus]\ntemperatures = [\"temp\", \"temp\"]", {"E-RT-RANGE 2:25"}},
      {"[bus]\ntemperatures = [\"temp_x y\"]", {"E-RT-RANGE 2:17"}},
      {"[bus.targets]\ncan_id = 1", {"E-RT-KEY 1:6"}},
      {"[bus]\ntarget = 3", {"E-RT-TYPE 2:10"}},
      {"[bus.target]\ncan_id = -1", {"E-RT-RANGE 2:10"}},
      {"[bus.target]\ncan_id = 0x800", {"E-RT-BUS 2:10"}},
      {"[bus.target]\ncan_id = 0x122", {"E-RT-BUS 1:1"}},  // told at the later of the two: joints
      {"[bus.target]\nregister = 65536", {"E-RT-RANGE 2:12"}},
      {"[bus.target]\nregister = 65530", {"E-RT-BUS 2:12"}},
      {"[bus.target]\nperiod_us = 0", {"E-RT-BUS 2:13"}},
      {"[bus.target]\ncount_um = 0", {"E-RT-BUS 2:12"}},
      {"[bus.robot]\ncount_um = 1", {"E-RT-KEY 2:1"}},
      {"[bus.offset]\ncan_id = 1", {"E-RT-BUS 1:1"}},
      {"[bus]\ncorrection = \"offset\"\n[bus.corrected]\ncan_id = 1", {"E-RT-BUS 3:1"}},
      {"[bus.target]\nperiod_us = 500", {"E-RT-BUS 1:1"}},  // too much load
      {"[bus.robot]\nperiod_us = 500000", {}},
      {"[bus.robot]\nperiod_us = 500001", {"E-RT-BUS 2:13"}},  // silent half of the time
  };
  for (const auto& [text, errors] : kCases) EXPECT_EQ(read(text).errors, errors) << text;
}

TEST(LayoutToml, TooMuchLoadIsNoMatterForModbus) {
  BusArm fast = six_axes();
  fast.cycle_s = 0.001;
  EXPECT_EQ(read("[bus]\n", fast).errors, Errors{"E-RT-BUS 1:1"});
  EXPECT_EQ(read("[bus]\n", fast, BusUse::kModbus).errors, Errors{});
}

/// In the register of a folder of before there may be something else.
TEST(LayoutToml, TheOwnersRegisterIsThereIfItIsNamed) {
  EXPECT_EQ(read("[bus]\n").layout.owner_register, 1288);
  EXPECT_EQ(read("[bus]\nowner_register = 0").layout.owner_register, std::nullopt);
  for (const auto& [text, owner] :
       {std::pair{"[bus]\n", std::optional<std::uint16_t>()},
        std::pair{"[bus]\nowner_register = 1288", std::optional<std::uint16_t>(1288)}}) {
    TomlSource source("rt.toml", text, "E-RT");
    const toml::table parsed = source.parse();
    TomlTable root(parsed, "", source);
    auto bus = root.table("bus");
    EXPECT_EQ(read_bus(*bus, six_axes(), BusUse::kModbus, MissingOwner::kNone).owner_register,
              owner);
  }
  for (const char* taken : {"1279", "1278", "1200", "65535"})
    EXPECT_EQ(read(std::string("[bus]\nowner_register = ") + taken, six_axes(), BusUse::kModbus)
                  .errors.empty(),
              std::string(taken) == "1279")
        << taken;
}

TEST(Reach, NumbersThatAreTooSmallForTheArmAreToldWithACountThatFits) {
  format::Chain chain;
  chain.joints.resize(6);
  for (auto& row : chain.joints) row.q_min = -3.0, row.q_max = 3.0;
  BusLayout layout = default_layout(6, 0.004);
  EXPECT_TRUE(find_short_reach(layout, chain, 0.05, "deploy.bus").empty());
  chain.joints[5].q_max = 8.4;  // 8.388607 is the most
  const auto faults = find_short_reach(layout, chain, 0.05, "deploy.bus");
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].key, "count_urad");
  EXPECT_EQ(faults[0].help, "[deploy.bus.joints] count_urad = 1.1");
  layout.can_format = CanFrame::Format::kFd;
  EXPECT_TRUE(find_short_reach(layout, chain, 0.05, "deploy.bus").empty());
  chain.joints[5].q_max = 3.0;
  layout = default_layout(6, 0.004, 0, CorrectionForm::kOffset);
  EXPECT_TRUE(find_short_reach(layout, chain, 0.0032767, "deploy.bus").empty());
  EXPECT_EQ(find_short_reach(layout, chain, 0.0033, "deploy.bus").at(0).help,
            "[deploy.bus.offset] count_um = 0.2");
}

}  // namespace
}  // namespace plumb::drivers
