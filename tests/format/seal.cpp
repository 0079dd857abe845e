// SPDX-License-Identifier: Apache-2.0
#include "seal.hpp"

#include <span>
#include <string_view>

#include "plumb/format/crc32.hpp"

namespace plumb::format {

std::uint32_t divided_crc(const std::byte* data, std::size_t size) {
  std::uint32_t rest = 0xFFFFFFFF;
  for (std::size_t i = 0; i < size; ++i)
    for (unsigned bit = 0; bit < 8; ++bit) {  // reflected: the lowest bit of a byte comes first
      const bool in = (std::to_integer<unsigned>(data[i]) >> bit & 1U) != 0;
      const bool top = (rest >> 31) != 0;
      rest <<= 1;
      if (in != top) rest ^= 0xF4ACFB13;
    }
  std::uint32_t reflected = 0;
  for (unsigned bit = 0; bit < 32; ++bit) reflected |= (rest >> bit & 1U) << (31 - bit);
  return reflected ^ 0xFFFFFFFF;
}

void put_u32(Bytes& bytes, std::size_t at, std::uint32_t value) {
  for (std::size_t k = 0; k < 4; ++k) bytes[at + k] = static_cast<std::byte>(value >> (8 * k));
}

std::uint32_t stated_schema(const Bytes& file) {
  const auto number = [&](std::size_t at, std::size_t bytes) {
    std::uint32_t out = 0;
    for (std::size_t k = 0; k < bytes; ++k)
      out |= std::to_integer<std::uint32_t>(file.at(at + k)) << (8 * k);
    return out;
  };
  const std::uint32_t table = number(0, 4);
  const std::uint32_t fields = table - number(table, 4);  // its own size, the table's, then places
  return number(table + number(fields + 4, 2), 4);
}

Bytes resealed(Bytes file) {
  const std::size_t at = file.size() - 4;
  put_u32(file, at, crc32p4(std::span(file).first(at)));
  return file;
}

Bytes sealed(Bytes payload) {
  payload.resize((payload.size() + 7) / 8 * 8);
  const std::size_t length = payload.size();
  for (char c : std::string_view("PLUMBSUM")) payload.push_back(static_cast<std::byte>(c));
  payload.resize(length + kTrailer);
  put_u32(payload, length + 8, static_cast<std::uint32_t>(length));
  return resealed(std::move(payload));
}

}  // namespace plumb::format
