// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <vector>

#include "plumb/drivers/modbus_frame.hpp"
#include "plumb/drivers/modbus_service.hpp"
#include "tests/fuzz/require.hpp"

using namespace plumb::drivers;
using plumb::tests::require;

namespace {

using Bytes = std::vector<std::uint8_t>;
constexpr std::int64_t kNow_ns = 1'000'000'000;

/// A server's parts, without its sockets. Made once: its registers are the only state, and laws
/// hold whatever they are.
struct Server {
  BusLayout layout = default_layout(6, 0.004);
  ModbusExchange exchange;
  ModbusRegisters registers{layout, Sender::kPlumb, kNow_ns, exchange};
  ModbusService service{registers, exchange.counters, kNow_ns};
};

void require_well_formed(std::span<const std::uint8_t> asked, std::span<const std::uint8_t> said) {
  require(said.size() >= 2 && said.size() <= kMostPdu, "an answer has the size of an answer");
  require((said[0] & 0x7f) == (asked[0] & 0x7f), "an answer is to its request");
  if (said[0] != asked[0] || (asked[0] & 0x80) != 0) {
    require(said.size() == 2 && said[1] >= 1 && said[1] <= 11, "a refusal says why");
    return;
  }
  switch (ModbusFunction{said[0]}) {
    case ModbusFunction::kReadHolding:
    case ModbusFunction::kReadInput:
    case ModbusFunction::kReadWrite:
      require(said[1] == 2 * word_at(asked, 3), "as many registers as were asked for");
      require(said.size() == 2U + said[1], "and no more bytes");
      return;
    case ModbusFunction::kWriteSingle:
    case ModbusFunction::kWriteMultiple:
      require(std::equal(said.begin(), said.end(), asked.begin()), "a write is echoed");
      return;
  }
  require(false, "no other function is served");
}

/// What the stream's frames are, received in pieces of `piece` bytes. Empties `pdus` if broken.
bool cut(std::span<const std::uint8_t> stream, std::size_t piece, std::vector<Bytes>& pdus) {
  ModbusFramer framer;
  while (!stream.empty()) {
    const auto room = framer.room();
    require(!room.empty(), "there is room for more");
    const std::size_t size = std::min({piece, stream.size(), room.size()});
    std::copy_n(stream.begin(), size, room.begin());
    stream = stream.subspan(size);
    framer.filled(size);
    for (;;) {
      const auto got = framer.next();
      if (got == ModbusFramer::Cut::kBroken) return false;
      if (got == ModbusFramer::Cut::kPart) break;
      require(!framer.pdu().empty() && framer.pdu().size() <= kMostPdu, "a frame holds a request");
      pdus.emplace_back(framer.pdu().begin(), framer.pdu().end());
    }
  }
  return true;
}

}  // namespace

/// Whatever bytes a peer sends, in whatever pieces: the same requests, each served or refused in
/// form; nothing but whole messages is delivered, and what is ours stays as it is.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static Server server;
  if (size < 1) return 0;
  const std::size_t piece = 1 + data[0] % 64;
  const std::span<const std::uint8_t> stream(data + 1, size - 1);
  std::vector<Bytes> whole, pieces;
  const bool sound = cut(stream, stream.size(), whole);
  require(cut(stream, piece, pieces) == sound, "pieces do not matter");
  require(whole == pieces, "pieces do not matter");

  const std::uint64_t before = server.exchange.counters.received;
  for (const Bytes& pdu : whole)
    require_well_formed(pdu, server.service.answer(pdu, 1 + pdu.size() % 2, kNow_ns));
  std::uint64_t delivered = 0;
  for (const auto& message : server.layout.messages) {
    BusMessage heard;
    if (!server.exchange.from_peer[static_cast<std::size_t>(message.kind)].take(heard)) continue;
    ++delivered;
    require(message.sender == Sender::kController, "only the peer's messages come");
    require(heard.kind == message.kind && heard.size == message.signals.size(), "whole");
  }
  require(delivered <= server.exchange.counters.received - before, "each is counted");
  const auto ours = server.layout.find(MessageKind::kSignature)->first_register;
  for (std::uint16_t word : server.registers.read(ours, 7, kNow_ns))
    require(word == 0, "a peer does not write what is ours");
  return 0;
}
