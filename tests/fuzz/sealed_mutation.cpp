// SPDX-License-Identifier: Apache-2.0
// Mutates what a model file says and makes its length and checksum right again; otherwise no input
// would get past them. Called by libFuzzer alone.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "seal.hpp"
#include "tests/random_numbers.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace plumb::tests {
namespace {

using format::Bytes;
using format::kTrailer;

constexpr std::size_t kBlock = 8;  // bytes: of padding, and of a double

/// Numbers at the edges of what a check may let through.
double telling(Random& random) {
  constexpr std::array<double, 14> kValues{
      0.0,      -0.0,   1.0,  -1.0,  0.5,      2.0,   1e4,
      4.9e-324, 1e-310, 1e-9, 1e308, HUGE_VAL, 100.0, std::numeric_limits<double>::quiet_NaN()};
  const double value = kValues[static_cast<std::size_t>(random.below(kValues.size()))];
  return random.below(2) == 0 ? value : -value * random.uniform(0.5, 2.0);
}

bool looks_like_a_number(double x) {
  return x == 0.0 || (std::abs(x) > 1e-12 && std::abs(x) < 1e6);
}

/// Doubles of the payload are aligned: one of them is scaled, so that it may pass the check, or
/// becomes a telling number. A few tries to hit a double and not an offset.
void change_number(Random& random, std::uint8_t* data, std::size_t payload) {
  if (payload < kBlock) return;
  constexpr int kTries = 8;
  std::uint8_t* at = data;
  double value = 0.0;
  for (int k = 0; k < kTries; ++k) {
    at = data + kBlock * (random.bits() % (payload / kBlock));
    std::memcpy(&value, at, sizeof value);
    if (looks_like_a_number(value)) break;
  }
  value = random.below(2) == 0 && value != 0.0 ? value * random.uniform(0.5, 1.5) : telling(random);
  std::memcpy(at, &value, sizeof value);
}

/// Seals `payload` bytes of data in place; there is room for padding and trailer.
std::size_t seal(std::uint8_t* data, std::size_t payload) {
  const auto* bytes = reinterpret_cast<const std::byte*>(data);
  const Bytes file = format::sealed(Bytes(bytes, bytes + payload));
  std::memcpy(data, file.data(), file.size());
  return file.size();
}

}  // namespace
}  // namespace plumb::tests

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max_size, unsigned seed) {
  using namespace plumb::tests;
  constexpr std::size_t kOverhead = kTrailer + kBlock;
  if (max_size <= kOverhead) return LLVMFuzzerMutate(data, size, max_size);
  Random random(seed);
  std::size_t payload = std::min(size > kTrailer ? size - kTrailer : size, max_size - kOverhead);
  if (random.below(2) == 0)
    change_number(random, data, payload);
  else
    payload = LLVMFuzzerMutate(data, payload, max_size - kOverhead);
  return seal(data, payload);
}
