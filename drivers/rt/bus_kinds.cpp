// SPDX-License-Identifier: Apache-2.0
#include "rt/bus_kinds.hpp"

#include "rt/can_source.hpp"
#include "rt/csv_source.hpp"
#include "rt/modbus_source.hpp"

namespace plumb::drivers::rt {

std::span<const BusKind> bus_kinds() {
  static constexpr BusKind kKinds[] = {
      {"can", &CanSource::read}, {"modbus", &ModbusSource::read}, {"csv", &CsvSource::read}};
  return kKinds;
}

}  // namespace plumb::drivers::rt
