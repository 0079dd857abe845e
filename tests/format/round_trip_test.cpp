// SPDX-License-Identifier: Apache-2.0
// What is written is what is read.
#include <gtest/gtest.h>

#include <cstdio>

#include "consistency.hpp"
#include "golden_models.hpp"
#include "plumb/format/reader.hpp"
#include "plumb/format/writer.hpp"
#include "random_model.hpp"
#include "seal.hpp"

namespace plumb::format {
namespace {

TEST(RoundTrip, ChangesNothingInAnyRandomModel) {
  constexpr std::uint64_t kCount = 500;
  std::printf("%d random models, seeds 1 ...\n", static_cast<int>(kCount));
  for (std::uint64_t seed = 1; seed <= kCount; ++seed) {
    const Model model = random_model(seed);
    ASSERT_EQ(inconsistency(model), "") << seed;
    const auto read = read_model(write_model(model));
    ASSERT_TRUE(std::holds_alternative<Model>(read)) << std::get<ReadError>(read).detail;
    EXPECT_EQ(std::get<Model>(read), model) << seed;
  }
}

TEST(RoundTrip, TheLargestModelOfTheLimitsFitsInAFile) {
  const Model model = largest_model();
  const Bytes bytes = write_model(model);
  std::printf("the largest model has %zu bytes\n", bytes.size());
  EXPECT_LT(bytes.size(), static_cast<std::size_t>(kMaxFileBytes));
  const auto read = read_model(bytes);
  ASSERT_TRUE(std::holds_alternative<Model>(read)) << std::get<ReadError>(read).detail;
  EXPECT_EQ(std::get<Model>(read), model);
}

TEST(RoundTrip, TheSameModelGivesTheSameBytesWhoseTrailerIsAsTheSchemaSays) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Bytes bytes = write_model(random_model(seed));
    EXPECT_EQ(bytes, write_model(random_model(seed)));
    EXPECT_EQ(bytes.size() % 8, 0U);
    EXPECT_EQ(sealed(Bytes(bytes.begin(), bytes.end() - kTrailer)), bytes);
  }
}

TEST(RoundTrip, AModelIsReadFromAnyAddress) {
  const Bytes bytes = write_model(six_axis_model());
  Bytes room(bytes.size() + 8);
  for (std::size_t shift = 0; shift < 8; ++shift) {
    std::copy(bytes.begin(), bytes.end(), room.begin() + static_cast<std::ptrdiff_t>(shift));
    const auto read = read_model(std::span<const std::byte>(room).subspan(shift, bytes.size()));
    ASSERT_TRUE(std::holds_alternative<Model>(read)) << shift;
    EXPECT_EQ(std::get<Model>(read), six_axis_model());
  }
}

}  // namespace
}  // namespace plumb::format
