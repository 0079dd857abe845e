// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/modbus_address.hpp"

#include <gtest/gtest.h>

using namespace plumb::drivers;

TEST(ModbusAddress, IsWrittenInNumbers) {
  EXPECT_EQ(text_of(*socket_address("192.168.0.7", 502)), "192.168.0.7:502");
  EXPECT_EQ(text_of(*socket_address("::1", 1502)), "[::1]:1502");
  for (const char* wrong :
       {"", "robot", "localhost", "1.2.3", "1.2.3.4.5", "256.1.1.1", " 1.2.3.4"})
    EXPECT_FALSE(socket_address(wrong, 502)) << wrong;
}

TEST(ModbusAddress, KnowsWhatEveryInterfaceIs) {
  for (const char* host : {"0.0.0.0", "::", "::ffff:0.0.0.0"})
    EXPECT_TRUE(is_wildcard(*socket_address(host, 1))) << host;
  for (const char* host : {"127.0.0.1", "::1", "::ffff:127.0.0.1", "10.0.0.1", "::2"})
    EXPECT_FALSE(is_wildcard(*socket_address(host, 1))) << host;
}

TEST(ModbusAddress, AHostIsTheSameOnEveryPortAndMappedIntoIpv6) {
  const auto host = [](const char* text, std::uint16_t port) {
    return *socket_address(text, port);
  };
  EXPECT_TRUE(same_host(host("10.0.0.1", 1), host("10.0.0.1", 2)));
  EXPECT_TRUE(same_host(host("10.0.0.1", 1), host("::ffff:10.0.0.1", 2)));
  EXPECT_FALSE(same_host(host("10.0.0.1", 1), host("10.0.0.2", 1)));
  EXPECT_FALSE(same_host(host("::1", 1), host("127.0.0.1", 1)));
}

TEST(ModbusAddress, TheLoopbackInterfaceHasTheLoopbackAddress) {
  const auto lo = interface_address("lo", 77);
  ASSERT_TRUE(lo);
  EXPECT_EQ(text_of(*lo), "127.0.0.1:77");
  EXPECT_FALSE(interface_address("nosuch0", 77));
}

TEST(ModbusAddress, IsSaidInWords) {
  EXPECT_EQ(text_of(ModbusAddress{TcpAddress{}}), "tcp 127.0.0.1:502");
  EXPECT_EQ(text_of(ModbusAddress{SerialLine{"/dev/ttyS0"}}), "serial /dev/ttyS0 115200 8E1");
}
