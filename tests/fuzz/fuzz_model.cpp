// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <span>

#include "plumb/format/crc32.hpp"
#include "plumb/format/reader.hpp"
#include "tests/fuzz/model_laws.hpp"
#include "tests/fuzz/require.hpp"

using namespace plumb;

/// Any bytes are a sound model, which never misbehaves in the cycle, or a refusal that says why.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  const auto read = format::read_model(bytes);
  if (const auto* model = std::get_if<format::Model>(&read)) {
    // Its check sum; with that included the sum of every file is the same.
    tests::require_sound(*model, format::crc32p4(bytes.first(bytes.size() - 4)));
    tests::require_written_and_read_back(*model);
  } else {
    tests::require(!std::get<format::ReadError>(read).detail.empty(), "a refusal says why");
  }
  return 0;
}
