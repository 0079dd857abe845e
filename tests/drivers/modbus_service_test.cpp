// SPDX-License-Identifier: Apache-2.0
// The server's answers, byte for byte, against the Modbus application protocol V1.1b3 by hand.
#include "plumb/drivers/modbus_service.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "tests/drivers/modbus_support.hpp"
#include "tests/random_numbers.hpp"

using namespace plumb::drivers;
using plumb::tests::lawful;

namespace {

using Bytes = std::vector<std::uint8_t>;
constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::uint64_t kPeer = 1, kOther = 2;

/// Robot (1 value: 5 registers from 1112) is the controller's; signature (2 values: 7 registers
/// from 1272) is ours.
class Service : public testing::Test {
 protected:
  Bytes ask(const Bytes& pdu, const ModbusPeer& peer = kPeer, std::int64_t now_ns = kSecond_ns) {
    const auto answer = service.answer(pdu, peer, now_ns);
    return {answer.begin(), answer.end()};
  }

  Bytes write_request(MessageKind kind, const std::vector<std::uint16_t>& words) const {
    const auto first = layout.find(kind)->first_register;
    const auto count = static_cast<std::uint8_t>(words.size());
    Bytes out{16,    static_cast<std::uint8_t>(first >> 8), static_cast<std::uint8_t>(first), 0,
              count, static_cast<std::uint8_t>(2 * count)};
    for (std::uint16_t word : words) {
      out.push_back(static_cast<std::uint8_t>(word >> 8));
      out.push_back(static_cast<std::uint8_t>(word));
    }
    return out;
  }

  std::vector<std::uint16_t> words_of(const BusMessage& message) const {
    ModbusCodec codec(layout);
    std::vector<std::uint16_t> out(codec.block(message.kind).count);
    EXPECT_TRUE(codec.encode(message, out));
    return out;
  }

  bool delivered(MessageKind kind, BusMessage& out) {
    return exchange.from_peer[static_cast<std::size_t>(kind)].take(out);
  }

  void say(const BusMessage& message, std::int64_t now_ns = kSecond_ns) {
    BusMessage stamped = message;
    stamped.time_ns = now_ns;
    exchange.to_peer[static_cast<std::size_t>(message.kind)].put(stamped);
  }

  BusLayout layout = default_layout(6, 0.004);
  ModbusExchange exchange;
  ModbusRegisters registers{layout, Sender::kPlumb, kSecond_ns / 10, exchange};
  ModbusService service{registers, exchange.counters, kSecond_ns / 2};
};

const Bytes kReadSignature{3, 0x04, 0xF8, 0, 7};

}  // namespace

TEST_F(Service, ReadsZerosBeforeTheFirstMessage) {
  EXPECT_EQ(ask(kReadSignature), (Bytes{3, 14, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
}

TEST_F(Service, ShowsTheNewestMessageInHoldingAndInputRegisters) {
  say(lawful(layout, MessageKind::kSignature, 3));
  say(lawful(layout, MessageKind::kSignature, 4));
  Bytes answer = ask(kReadSignature);
  ASSERT_EQ(answer.size(), 16U);
  // 7 * 4 + 0 and 7 * 4 + 1 as int32 with the high word first, then the counter.
  EXPECT_EQ(Bytes(answer.begin(), answer.begin() + 12),
            (Bytes{3, 14, 0, 0, 0, 28, 0, 0, 0, 29, 0, 4}));
  answer[0] = 4;
  EXPECT_EQ(ask({4, 0x04, 0xF8, 0, 7}), answer);
}

TEST_F(Service, AMessageTheCycleDoesNotRenewLosesItsCheckSumAndNothingElse) {
  say(lawful(layout, MessageKind::kSignature, 4));
  const Bytes fresh = ask(kReadSignature);
  const Bytes stale = ask(kReadSignature, kPeer, 3 * kSecond_ns);
  EXPECT_EQ(Bytes(fresh.begin(), fresh.begin() + 12), Bytes(stale.begin(), stale.begin() + 12));
  for (std::size_t i = 12; i < 16; ++i) EXPECT_EQ(fresh[i] ^ stale[i], 0xff);
  EXPECT_EQ(ask(kReadSignature, kPeer, 4 * kSecond_ns), stale) << "once";
  say(lawful(layout, MessageKind::kSignature, 4), 4 * kSecond_ns);
  EXPECT_EQ(ask(kReadSignature, kPeer, 4 * kSecond_ns), fresh) << "the cycle is back";
}

TEST_F(Service, DeliversAMessageOnceItsLastRegisterIsWritten) {
  const BusMessage said = lawful(layout, MessageKind::kRobot, 9);
  const auto words = words_of(said);
  BusMessage heard;
  for (std::size_t i = 0; i < words.size(); ++i) {
    EXPECT_FALSE(delivered(MessageKind::kRobot, heard));
    const auto address = static_cast<std::uint8_t>(0x58 + i);  // 1112 = 0x0458
    const Bytes request{6, 0x04, address, static_cast<std::uint8_t>(words[i] >> 8),
                        static_cast<std::uint8_t>(words[i])};
    EXPECT_EQ(ask(request), request);
  }
  ASSERT_TRUE(delivered(MessageKind::kRobot, heard));
  EXPECT_EQ(heard.counter, 9);
  EXPECT_EQ(heard.time_ns, kSecond_ns);
  EXPECT_TRUE(plumb::tests::is_lawful(layout, heard));
}

TEST_F(Service, RandomRegistersAreNoMessageThatIsPackedOtherwise) {
  plumb::tests::Random random(5);
  auto words = words_of(lawful(layout, MessageKind::kJoints, 9));
  for (long i = 0; i < plumb::tests::scaled(20'000); ++i) {
    for (auto& word : words) word = static_cast<std::uint16_t>(random.below(4) * random.below(70));
    ask(write_request(MessageKind::kJoints, words));
    ASSERT_FALSE(exchange.packing.load().any()) << i;
  }
  EXPECT_EQ(exchange.counters.received, 0U);
}

TEST_F(Service, OneMessageThatIsPackedOtherwiseIsNamedUntilItIsRight) {
  ask(write_request(MessageKind::kRobot, words_of(lawful(layout, MessageKind::kRobot, 1))));
  for (std::uint16_t counter = 1; counter <= 5; ++counter) {
    EXPECT_EQ(exchange.packing.load().any(), counter > 3) << "three messages in a row";
    auto words = words_of(lawful(layout, MessageKind::kJoints, counter));
    for (std::size_t i = 0; i < 12; i += 2) std::swap(words[i], words[i + 1]);
    std::swap(words[13], words[14]);  // of the check sum; the counter stands alone
    for (int again = 0; again < 3; ++again) ask(write_request(MessageKind::kJoints, words));
  }
  const RegisterPacking packing = exchange.packing.load();
  EXPECT_EQ(packing.kind, MessageKind::kJoints);
  EXPECT_EQ(packing.words, RegisterPacking::Words::kAll);
  EXPECT_EQ(packing.sum_content, RegisterPacking::Sum::kAsLaidOut);
  EXPECT_TRUE(packing.alone);
  EXPECT_EQ(exchange.counters.received, 1U) << "nothing is decoded by it";
  ask(write_request(MessageKind::kJoints, words_of(lawful(layout, MessageKind::kJoints, 9))));
  EXPECT_FALSE(exchange.packing.load().any());
}

TEST_F(Service, WritesInOneRequestAndReadsInTheSame) {
  const auto words = words_of(lawful(layout, MessageKind::kRobot, 9));
  EXPECT_EQ(ask(write_request(MessageKind::kRobot, words)), (Bytes{16, 0x04, 0x58, 0, 5}));
  EXPECT_EQ(ask(write_request(MessageKind::kRobot, words)), (Bytes{16, 0x04, 0x58, 0, 5}));
  EXPECT_EQ(exchange.counters.received, 1U);
  EXPECT_EQ(exchange.counters.repeated, 1U);
  Bytes both{23, 0x04, 0x5B, 0, 1, 0x04, 0x58, 0, 5, 10};  // reads 1115, the high word of the sum
  const Bytes write =
      write_request(MessageKind::kRobot, words_of(lawful(layout, MessageKind::kRobot, 10)));
  both.insert(both.end(), write.begin() + 6, write.end());
  EXPECT_EQ(ask(both), (Bytes{23, 2, write[12], write[13]}));
  EXPECT_EQ(exchange.counters.received, 2U);
}

TEST_F(Service, AWrongBitInAnyRegisterIsCountedAndNotDelivered) {
  const auto words = words_of(lawful(layout, MessageKind::kRobot, 9));
  std::uint64_t tried = 0;
  for (std::size_t bit = 0; bit < 16 * words.size(); ++bit) {
    auto wrong = words;
    wrong[bit / 16] = static_cast<std::uint16_t>(wrong[bit / 16] ^ (1U << bit % 16));
    ask(write_request(MessageKind::kRobot, wrong));
    EXPECT_EQ(exchange.counters.corrupt, ++tried);
  }
  BusMessage heard;
  EXPECT_FALSE(delivered(MessageKind::kRobot, heard));
}

TEST_F(Service, RefusesAsTheSpecificationSays) {
  EXPECT_EQ(ask({1, 0, 0, 0, 1}), (Bytes{0x81, 1})) << "coils";
  EXPECT_EQ(ask({43, 14, 1, 0}), (Bytes{0xAB, 1})) << "device identification";
  EXPECT_EQ(ask({3, 0x04, 0xF8, 0, 0}), (Bytes{0x83, 3})) << "none";
  EXPECT_EQ(ask({3, 0x04, 0xF8, 0, 126}), (Bytes{0x83, 3})) << "too many";
  EXPECT_EQ(ask({3, 0x04, 0xF8, 0}), (Bytes{0x83, 3})) << "cut short";
  EXPECT_EQ(ask({3, 0x04, 0xF8, 0, 7, 0}), (Bytes{0x83, 3})) << "too long";
  EXPECT_EQ(ask({3, 0, 0, 0, 1}), (Bytes{0x83, 2})) << "before the layout";
  EXPECT_EQ(ask({3, 0x04, 0xF8, 0, 8}), (Bytes{0x83, 2})) << "beyond the layout";
  EXPECT_EQ(ask({3, 0xFF, 0xFF, 0, 2}), (Bytes{0x83, 2})) << "beyond 65535";
  EXPECT_EQ(ask({6, 0x04, 0xF8, 0, 7}), (Bytes{0x86, 2})) << "ours is not theirs to write";
  EXPECT_EQ(ask({6, 0x04, 0x5D, 0, 7}), (Bytes{0x86, 2})) << "between messages";
  EXPECT_EQ(ask({16, 0x04, 0x58, 0, 1, 2, 0}), (Bytes{0x90, 3})) << "a byte is missing";
  EXPECT_EQ(ask({16, 0x04, 0x58, 0, 1, 4, 0, 0}), (Bytes{0x90, 3})) << "wrong count of bytes";
  EXPECT_EQ(ask({16}), (Bytes{0x90, 3}));
  EXPECT_EQ(ask({23, 0, 0, 0, 1}), (Bytes{0x97, 3}));
  EXPECT_EQ(exchange.counters.refusals, 15U);
  EXPECT_EQ(exchange.counters.transactions, 0U);
}

TEST_F(Service, ASecondWriterIsRefusedUntilTheFirstIsSilentOrGone) {
  const auto request =
      write_request(MessageKind::kRobot, words_of(lawful(layout, MessageKind::kRobot, 1)));
  const Bytes done{16, 0x04, 0x58, 0, 5}, busy{0x90, 6};
  EXPECT_EQ(ask(request, kPeer), done);
  EXPECT_EQ(ask(request, kOther), busy);
  EXPECT_EQ(exchange.counters.foreign_senders, 1U);
  EXPECT_EQ(ask(kReadSignature, kOther).size(), 16U) << "it may read";
  EXPECT_EQ(ask(request, kOther, 2 * kSecond_ns), done) << "the first is silent";
  EXPECT_EQ(ask(request, kPeer, 2 * kSecond_ns), busy);
  service.leave(kOther);
  EXPECT_EQ(ask(request, kPeer, 2 * kSecond_ns), done) << "the other is gone";
}

TEST(ModbusFramer, CutsAStreamWhereverItIsBroken) {
  const Bytes stream{0, 1, 0, 0, 0, 6, 1, 3, 4, 0xF8, 0, 7, 0, 2, 0, 0, 0, 3, 9, 8, 7};
  for (std::size_t piece = 1; piece <= stream.size(); ++piece) {
    ModbusFramer framer;
    std::vector<Bytes> pdus;
    for (std::size_t at = 0; at < stream.size(); at += piece) {
      const std::size_t size = std::min(piece, stream.size() - at);
      std::copy_n(stream.begin() + static_cast<std::ptrdiff_t>(at), size, framer.room().begin());
      framer.filled(size);
      while (framer.next() == ModbusFramer::Cut::kFrame)
        pdus.emplace_back(framer.pdu().begin(), framer.pdu().end());
    }
    EXPECT_EQ(pdus, (std::vector<Bytes>{{3, 4, 0xF8, 0, 7}, {8, 7}})) << piece;
    EXPECT_EQ(framer.header().transaction, 2);
    EXPECT_EQ(framer.header().unit, 9);
    EXPECT_FALSE(framer.part());
  }
}

TEST(ModbusFramer, GivesUpAStreamThatIsNoModbus) {
  for (const Bytes& bytes : {Bytes{0, 1, 0, 5}, Bytes{0, 1, 0, 0, 0, 1}, Bytes{0, 1, 0, 0, 0, 255},
                             Bytes{0, 1, 0, 0, 0xFF, 0xFF}, Bytes{'G', 'E', 'T', ' '}}) {
    ModbusFramer framer;
    std::copy(bytes.begin(), bytes.end(), framer.room().begin());
    framer.filled(bytes.size());
    EXPECT_EQ(framer.next(), ModbusFramer::Cut::kBroken);
  }
}
