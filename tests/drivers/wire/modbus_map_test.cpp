// SPDX-License-Identifier: Apache-2.0
#include "bus_text/modbus_map.hpp"

#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "bus_text/bus_arm.hpp"
#include "plumb/drivers/modbus_codec.hpp"

namespace plumb::drivers {
namespace {

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> out(1);
  bool quoted = false;
  for (const char c : line)
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      out.emplace_back();
    else
      out.back() += c;
  return out;
}

TEST(ModbusMap, CsvHasEveryRegisterOnce) {
  const BusLayout layout = default_layout(6, 0.004, 2);
  std::istringstream lines(modbus_map_csv(layout));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "register,registers,message,value,type,unit,factor,sender,period_us,meaning");
  std::map<int, int> seen;
  while (std::getline(lines, line)) {
    const auto f = fields(line);
    ASSERT_EQ(f.size(), 10U) << line;
    for (int i = 0; i < std::stoi(f[1]); ++i) ++seen[std::stoi(f[0]) + i];
  }
  std::size_t registers = 2;  // the owner's number
  for (const MessageLayout& m : layout.messages) registers += modbus_registers(m);
  EXPECT_EQ(seen.size(), registers);
  EXPECT_EQ(modbus_registers(layout), registers);
  for (const auto& [first, count] : seen) EXPECT_EQ(count, 1) << first;
}

/// Written down by hand: the target's block begins at 1048, its counter is the 13th register.
TEST(ModbusMap, CsvSaysWhereTheTargetStands) {
  const std::string csv = modbus_map_csv(default_layout(6, 0.004));
  for (const char* line :
       {"1048,2,target,x,int32,um,1,controller,4000,\"\"\n",
        "1058,2,target,rz,int32,urad,1,controller,4000,\"\"\n",
        "1060,1,target,counter,uint16,,1,controller,4000,\"Of the cycle\"\n",
        "1061,2,target,crc,uint32,,1,controller,4000,\"CRC-32P4 of this block\"\n",
        "1200,2,corrected,x,int32,um,1,plumb-rt,4000,\"\"\n",
        "1288,2,owner,token,uint32,,1,plumb-rt,0,"})
    EXPECT_NE(csv.find(line), std::string::npos) << line;
}

/// What the codec writes is at the registers that the map names.
TEST(ModbusMap, IsTrueOfTheCodec) {
  const BusLayout layout = default_layout(6, 0.004);
  const ModbusCodec codec(layout);
  BusMessage message;
  message.kind = MessageKind::kTarget;
  message.size = 6;
  message.counter = 4321;
  message.values = {0, 0, 0, 0, 0, 70000e-6};  // rz
  std::vector<std::uint16_t> words(codec.block(message.kind).count);
  ASSERT_TRUE(codec.encode(message, words));
  EXPECT_EQ(words[1058 - 1048] * 65536 + words[1059 - 1048], 70000);
  EXPECT_EQ(words[1060 - 1048], 4321);
}

TEST(ModbusMap, MarkdownHasATableAMessageAndSaysTheWordOrder) {
  BusLayout layout = default_layout(6, 0.004);
  std::string text = modbus_map_markdown(layout, "Line (F08-1234)");
  EXPECT_EQ(text.rfind("# Modbus map: Line (F08-1234)\n", 0), 0U);
  EXPECT_NE(text.find("the first holds the high word"), std::string::npos);
  EXPECT_NE(text.find("| 1048 | x | int32 | um | 1 |  |\n"), std::string::npos);
  for (const MessageLayout& m : layout.messages)
    EXPECT_NE(text.find("\n## " + m.name + "\n"), std::string::npos);
  EXPECT_NE(text.find("\n## owner\n"), std::string::npos);
  layout.owner_register.reset();
  EXPECT_EQ(modbus_map_markdown(layout, "").find("owner"), std::string::npos);
  layout.word_order = ByteOrder::kLittle;
  EXPECT_NE(modbus_map_markdown(layout, "").find("the first holds the low word"),
            std::string::npos);
}

}  // namespace
}  // namespace plumb::drivers
