// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "plumb/drivers/bus_message.hpp"
#include "plumb/drivers/can_frame.hpp"

namespace plumb::drivers {

enum class Sender : std::uint8_t { kController, kPlumb };
enum class ByteOrder : std::uint8_t { kLittle, kBig };
enum class CorrectionForm : std::uint8_t { kPose, kOffset };

/// One value of a message. Its value in SI is the integer on the wire times `scale`.
struct Signal {
  std::string name;    // "x", "q1": unique within its message
  std::string unit;    // shown to people: "um", "urad", "kg", "degC", "s"; "" without unit
  double scale = 1.0;  // SI units per count
};

/// One message: its values, its sender and its place on the bus.
struct MessageLayout {
  MessageKind kind = MessageKind::kJoints;
  std::string name;  // "joints"
  Sender sender = Sender::kController;
  std::vector<Signal> signals;
  std::uint32_t can_id = 0;          // identifier of its first frame; the others count up from it
  std::uint16_t first_register = 0;  // Modbus holding register, counted from 0
  double period_s = 0.004;
};

/// The place of every value of every message, on CAN and in Modbus registers. The codecs, the DBC
/// file, the Modbus map and the bus load all come from this one table.
struct BusLayout {
  CanFrame::Format can_format = CanFrame::Format::kClassic;
  CanFrame::Id id_kind = CanFrame::Id::kStandard;
  ByteOrder byte_order = ByteOrder::kLittle;  // of numbers longer than a byte, in CAN frames
  ByteOrder word_order = ByteOrder::kBig;     // of the two registers of a value, in Modbus
  CorrectionForm correction = CorrectionForm::kPose;
  /// Modbus: where plumb-rt as client writes a random number by which it knows its registers again.
  /// None: the controller has no place for it.
  std::optional<std::uint16_t> owner_register = std::nullopt;
  double bit_rate = 1e6;       // arbitration phase [bit/s]
  double data_bit_rate = 4e6;  // data phase of CAN FD [bit/s]
  std::vector<MessageLayout> messages;

  const MessageLayout* find(MessageKind kind) const;
};

/// The registers of the owner's number, in the word order of the others.
inline constexpr std::uint16_t kOwnerRegisters = 2;

/// The default layout for an arm of `joints` joints. `temperatures`: number of temperatures that
/// the model uses.
///
/// Sent every cycle: joints, target, corrected (or offset), and for more than six joints commanded,
/// which they need as seed. Sent every cycle, but not faster than every 4 ms: controller. Every
/// 20 ms: status and actual; an actual pose belongs to the joints with the same counter. Every
/// 200 ms: robot, context, signature.
BusLayout default_layout(int joints, double cycle_s, int temperatures = 0,
                         CorrectionForm correction = CorrectionForm::kPose);

/// The default layout of one message, including messages that default_layout leaves out.
MessageLayout default_message(MessageKind kind, int joints, double cycle_s, int temperatures = 0);

/// Name of a message, for example "joints".
const char* name_of(MessageKind kind) noexcept;

/// Size of a signal's unit in SI units: 1e-6 for "um" and "urad", 1 for the others.
double si_per_unit(const std::string& unit);

/// Number of frames of a message on CAN, and of its registers in Modbus (values, counter,
/// checksum).
std::size_t can_frames(const BusLayout& layout, const MessageLayout& message);
std::size_t modbus_registers(const MessageLayout& message);
std::size_t modbus_registers(const BusLayout& layout);

/// The fraction of the bus time that the layout takes in the worst case, when every frame has the
/// most stuff bits possible (classic: ISO 11898-1; FD: both bit rates).
double worst_bus_load(const BusLayout& layout);
inline constexpr double kMostBusLoad = 0.70;

/// One fault of a layout. Faults are identifiers out of range or used twice, registers that overlap
/// or do not fit, a scale or period of 0, and a period longer than half of longest_silence_s(),
/// with which no session can begin; for CAN also wrong bit rates and too much load.
struct LayoutFault {
  std::string message;  // name of the message; empty for a fault of the whole layout
  std::string key;      // "can_id", "register", "scale", "period_us", "bit_rate", "load"
  std::string what;     // one sentence without a full stop
  std::string help;
};
enum class BusUse : std::uint8_t { kCan, kModbus };

/// All faults of a layout; empty if it can be used.
std::vector<LayoutFault> find_faults(const BusLayout& layout, BusUse use = BusUse::kCan);

}  // namespace plumb::drivers
