// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "plumb/drivers/bus_message.hpp"
#include "plumb/drivers/can_frame.hpp"

namespace plumb::drivers {

enum class Sender : std::uint8_t { kController, kPlumb };
enum class ByteOrder : std::uint8_t { kLittle, kBig };
enum class CorrectionForm : std::uint8_t { kPose, kOffset };

/// One value of a message: counts on the wire times scale is the value in SI.
struct Signal {
  std::string name;    // "x", "q1": unique within its message
  std::string unit;    // people see it in: "um", "urad", "kg", "degC", "s"; "" for a bare number
  double scale = 1.0;  // SI per count
};

/// One message: what it holds and where it goes.
struct MessageLayout {
  MessageKind kind = MessageKind::kJoints;
  std::string name;  // "joints"
  Sender sender = Sender::kController;
  std::vector<Signal> signals;
  std::uint32_t can_id = 0;          // of its first frame; the others follow
  std::uint16_t first_register = 0;  // Modbus holding register, counted from 0
  double period_s = 0.004;
};

/// Where every value of every message stands, on CAN and in Modbus registers: the one table from
/// which come the codecs, the DBC file, the Modbus map and the bus load.
struct BusLayout {
  CanFrame::Format can_format = CanFrame::Format::kClassic;
  CanFrame::Id id_kind = CanFrame::Id::kStandard;
  ByteOrder byte_order = ByteOrder::kLittle;  // in CAN frames, of all that is longer than a byte
  ByteOrder word_order = ByteOrder::kBig;     // of the two registers of a value
  CorrectionForm correction = CorrectionForm::kPose;
  double bit_rate = 1e6;       // arbitration phase [bit/s]
  double data_bit_rate = 4e6;  // data phase of CAN FD [bit/s]
  std::vector<MessageLayout> messages;

  const MessageLayout* find(MessageKind kind) const;
};

/// The layout for an arm of `joints` joints when nothing else is asked for. `temperatures`: how
/// many the model listens to.
///
/// Every cycle: joints, target, corrected (or offset), and commanded for more than six joints, who
/// need it as seed. Every 4 ms at most: controller. Every 20 ms: status and actual; an actual pose
/// belongs to the joints of the same counter. Every 200 ms: robot, context, signature.
BusLayout default_layout(int joints, double cycle_s, int temperatures = 0,
                         CorrectionForm correction = CorrectionForm::kPose);

/// One message of it; also those that it leaves out.
MessageLayout default_message(MessageKind kind, int joints, double cycle_s, int temperatures = 0);

/// "joints"
const char* name_of(MessageKind kind) noexcept;

/// SI per unit of a signal: 1e-6 for "um" and "urad", 1 for the others.
double si_per_unit(const std::string& unit);

/// Frames of a message on CAN, and registers in Modbus (values, counter, check sum).
std::size_t can_frames(const BusLayout& layout, const MessageLayout& message);
std::size_t modbus_registers(const MessageLayout& message);

/// The share of the bus that the layout takes in the worst case: every frame stuffed as densely as
/// can be (classic: ISO 11898-1; FD: both bit rates).
double worst_bus_load(const BusLayout& layout);
inline constexpr double kMostBusLoad = 0.70;

/// What is wrong with a layout: identifiers out of range or twice, registers that overlap or do not
/// fit, a scale or period of 0, a period longer than half of longest_silence_s(), with which no
/// session comes about; for CAN also bit rates and too much load. Empty: usable.
struct LayoutFault {
  std::string message;  // of which message; empty: of the layout
  std::string key;      // "can_id", "register", "scale", "period_us", "bit_rate", "load"
  std::string what;     // one sentence without a full stop
  std::string help;
};
enum class BusUse : std::uint8_t { kCan, kModbus };
std::vector<LayoutFault> find_faults(const BusLayout& layout, BusUse use = BusUse::kCan);

}  // namespace plumb::drivers
