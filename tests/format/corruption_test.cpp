// SPDX-License-Identifier: Apache-2.0
// Every truncation and every corruption of a golden file: refused, or read to something sound.
#include <gtest/gtest.h>

#include <cinttypes>
#include <cstdio>
#include <cstdlib>

#include "consistency.hpp"
#include "golden_models.hpp"
#include "plumb/format/reader.hpp"
#include "plumb/format/writer.hpp"
#include "seal.hpp"

namespace plumb::format {
namespace {

constexpr int kChanges = 10;  // eight single bits, all zeros, all ones

Bytes changed(Bytes bytes, std::size_t at, int change) {
  if (change < 8)
    bytes[at] ^= std::byte(1U << change);
  else
    bytes[at] = change == 8 ? std::byte{0} : std::byte{0xFF};
  return bytes;
}

struct Tally {
  long refused = 0;
  long accepted = 0;
};

void try_one(const Bytes& bytes, Tally& tally) {
  const auto read = read_model(bytes);
  if (const Model* model = std::get_if<Model>(&read)) {
    ASSERT_EQ(inconsistency(*model), "");
    ++tally.accepted;
  } else {
    EXPECT_FALSE(std::get<ReadError>(read).detail.empty());
    ++tally.refused;
  }
}

TEST(Corruption, EveryTruncationIsRefusedAndNamedAsSuch) {
  for (const auto& [name, model] : golden_models()) {
    const Bytes whole = write_model(model);
    for (std::size_t size = 0; size < whole.size(); ++size) {
      const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
      const auto read = read_model(cut);
      ASSERT_TRUE(std::holds_alternative<ReadError>(read)) << name << " cut to " << size;
      // Before the identifier is complete nobody can know what the file was.
      const bool anonymous = size > 0 && size < 8;
      EXPECT_EQ(std::get<ReadError>(read).code,
                anonymous ? ReadErrorCode::kNotAModel : ReadErrorCode::kTruncated)
          << name << " cut to " << size;
    }
  }
}

TEST(Corruption, BytesPutBehindTheEndAreRefused) {
  for (std::size_t more = 1; more <= 40; ++more) {
    Bytes longer = write_model(planar_model());
    longer.resize(longer.size() + more);
    EXPECT_TRUE(std::holds_alternative<ReadError>(read_model(longer))) << more;
  }
}

TEST(Corruption, EverySingleBitFlipAndEveryByteSetToZeroOrOnesIsRefused) {
  for (const auto& [name, model] : golden_models()) {
    const Bytes whole = write_model(model);
    for (std::size_t i = 0; i < whole.size(); ++i)
      for (int change = 0; change < kChanges; ++change) {
        const Bytes bad = changed(whole, i, change);
        if (bad == whole) continue;
        EXPECT_TRUE(std::holds_alternative<ReadError>(read_model(bad))) << name << " byte " << i;
      }
  }
}

TEST(Corruption, WithTheChecksumMadeRightAgainNothingUnsoundIsAccepted) {
  Tally tally;
  for (const auto& [name, model] : golden_models()) {
    const Bytes whole = write_model(model);
    for (std::size_t i = 0; i + kTrailer < whole.size(); ++i)
      for (int change = 0; change < kChanges; ++change) {
        SCOPED_TRACE(name + " byte " + std::to_string(i));
        try_one(resealed(changed(whole, i, change)), tally);
      }
  }
  std::printf("%ld refused, %ld accepted and sound\n", tally.refused, tally.accepted);
  EXPECT_GT(tally.refused, 0);
  EXPECT_GT(tally.accepted, 0);  // a digit of a name, the last bit of a length: harmless
}

TEST(Corruption, RandomDamageWithARightChecksumNeverGivesAnUnsoundModel) {
  const char* scale = std::getenv("PLUMB_TEST_SCALE");
  const long count = 20000 * (scale != nullptr ? std::max(1L, std::atol(scale)) : 1L);
  constexpr std::uint64_t kSeed = 20260102;
  std::uint64_t state = kSeed;
  const auto below = [&](std::size_t n) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    return static_cast<std::size_t>((state >> 33) % n);
  };
  std::vector<Bytes> files;
  for (const auto& golden : golden_models()) files.push_back(write_model(golden.second));
  Tally tally;
  for (long k = 0; k < count; ++k) {
    Bytes bad = files[below(files.size())];
    for (std::size_t hits = 1 + below(6); hits > 0; --hits)
      bad[below(bad.size() - kTrailer)] = static_cast<std::byte>(below(256));
    try_one(resealed(std::move(bad)), tally);
    ASSERT_FALSE(HasFatalFailure()) << "case " << k;
  }
  std::printf("%ld cases, seed %" PRIu64 ": %ld refused, %ld accepted and sound\n", count, kSeed,
              tally.refused, tally.accepted);
}

}  // namespace
}  // namespace plumb::format
