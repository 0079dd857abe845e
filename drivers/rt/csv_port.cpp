// SPDX-License-Identifier: Apache-2.0
#include "rt/csv_port.hpp"

#include "plumb/drivers/bus_content.hpp"
#include "plumb/drivers/time_source.hpp"

namespace plumb::drivers::rt {
namespace {

constexpr int kParts = 6;  // messages per row

constexpr ControllerState kReady{
    .drives_on = true, .automatic = true, .protective_stop = false, .correction_enabled = true};

}  // namespace

CsvPort::CsvPort(std::vector<CsvTarget> rows, const LoadedModel& model, std::uint32_t robot,
                 const BusLayout& layout, int lead)
    : rows_(std::move(rows)), robot_(robot), sent_(layout), heard_(layout), lead_(lead) {
  for (const auto& row : rows_) {
    auto angles = row.q;
    model.coupling().to_angles(angles);
    X_BN_.push_back(model.corrector().nominal().forward(angles));
  }
}

BusMessage CsvPort::compose(int part) const noexcept {
  const CsvTarget& row = rows_[row_];
  switch (part) {
    case 0:
      return controller_message(kReady, counter_);
    case 1:
      return robot_message(robot_, counter_);
    case 2:
      return joints_message(MessageKind::kJoints, row.q, counter_);
    case 3:
      return joints_message(MessageKind::kCommanded, row.q, counter_);
    case 4:
      return pose_message(MessageKind::kActual, X_BN_[row_], counter_);
    default:
      return pose_message(MessageKind::kTarget, row.X_BD, counter_);
  }
}

void CsvPort::advance() noexcept {
  part_ = 0;
  ++counter_;
  if (lead_ > 0) {
    --lead_;
  } else if (row_ + 1 < rows_.size()) {
    ++row_;
  } else {
    finished_.store(true, std::memory_order_relaxed);
  }
}

/// Replaces the message by what a receiver decodes from it. False if the layout has no such
/// message.
bool CsvPort::carried(BusMessage& message) noexcept {
  const BusMessage composed = message;
  Heard heard = Heard::kNotOurs;
  for (CanFrame frame : sent_.encode(composed)) {
    frame.time_ns = composed.time_ns;
    heard = heard_.hear(frame, message);
  }
  return heard == Heard::kComplete;
}

bool CsvPort::receive(BusMessage& message) noexcept {
  while (part_ < kParts) {
    message = compose(part_++);
    message.time_ns = MonotonicTime::now_ns();
    if (!carried(message)) continue;
    ++counters_.received;
    return true;
  }
  advance();
  return false;
}

}  // namespace plumb::drivers::rt
