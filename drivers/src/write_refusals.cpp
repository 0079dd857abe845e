// SPDX-License-Identifier: Apache-2.0
#include "write_refusals.hpp"

namespace plumb::drivers {

void WriteRefusals::refused(std::size_t block, std::uint32_t exception,
                            std::int64_t now_ns) noexcept {
  Since& since = since_[block];
  if (since.exception == 0) since.first_ns = now_ns;
  since.exception = exception;
  since.last_ns = now_ns;
}

WriteRefusal WriteRefusals::find(const std::vector<ModbusBlock>& blocks,
                                 std::int64_t now_ns) noexcept {
  for (std::size_t i = 0; i < since_.size(); ++i) {
    if (since_[i].exception == 0) continue;
    if (now_ns - since_[i].last_ns > kForget_ns)
      taken(i);
    else if (since_[i].last_ns - since_[i].first_ns >= kLimit_ns)
      return {since_[i].exception, blocks[i].first, blocks[i].count};
  }
  return {};
}

}  // namespace plumb::drivers
