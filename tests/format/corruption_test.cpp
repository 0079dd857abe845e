// SPDX-License-Identifier: Apache-2.0
// Every truncation and every corruption of a golden file: refused, or read to something sound.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "golden_models.hpp"
#include "plumb/format/crc32.hpp"
#include "plumb/format/reader.hpp"
#include "plumb/format/writer.hpp"

namespace plumb::format {
namespace {

using Bytes = std::vector<std::byte>;

/// The checksum made right again, so the corruption reaches the verifier and the semantic check.
Bytes resealed(Bytes bytes) {
  const std::size_t at = bytes.size() - 4;
  const std::uint32_t crc = crc32p4(std::span(bytes).first(at));
  for (std::size_t k = 0; k < 4; ++k) bytes[at + k] = static_cast<std::byte>(crc >> (8 * k));
  return bytes;
}

/// Walks to the deepest leaf of every path; false if an index is outside or the walk does not end.
bool walks(const Tree& tree, int node, int depth, std::size_t joints) {
  if (depth > tree.depth) return false;
  if (node < 0) {
    const auto leaf = static_cast<std::size_t>(~node);
    return (leaf + 1) * (joints + 1) <= tree.coefficients.size() &&
           2 * leaf + 2 <= tree.bounds.size();
  }
  if (static_cast<std::size_t>(node) >= tree.nodes.size()) return false;
  const TreeNode& n = tree.nodes[static_cast<std::size_t>(node)];
  return n.input < joints && std::isfinite(n.threshold) && walks(tree, n.low, depth + 1, joints) &&
         walks(tree, n.high, depth + 1, joints);
}

/// Written apart from the reader's own check: what the cycle relies on.
bool can_be_evaluated(const Model& m) {
  const std::size_t n = m.nominal.joints.size();
  bool ok = n >= 1 && n <= kMaxJoints && m.calibrated.joints.size() == n;
  for (const auto* chain : {&m.nominal, &m.calibrated})
    for (const auto& j : chain->joints)
      for (double x : {j.alpha, j.a, j.d, j.theta, j.beta, j.scale, j.offset, j.q_min, j.q_max})
        ok = ok && std::isfinite(x);
  for (const auto& tree : m.trees) {
    if (tree.bounds.empty()) {
      ok = ok && tree.nodes.empty();
      continue;
    }
    ok = ok && m.domain.q_min.size() == n && m.domain.q_max.size() == n;
    ok = ok && walks(tree, tree.nodes.empty() ? ~0 : 0, 0, n);
    for (double x : tree.coefficients) ok = ok && std::isfinite(x);
  }
  for (const auto& effect : m.effects)
    for (auto joint : effect.joints) ok = ok && joint < n;
  return ok && m.guard.length_scale_m > 0.0 && m.guard.max_correction_m > 0.0;
}

struct Tally {
  long refused = 0;
  long accepted = 0;
};

void try_one(const Bytes& bytes, Tally& tally) {
  const auto read = read_model(bytes);
  if (const Model* model = std::get_if<Model>(&read)) {
    ASSERT_TRUE(can_be_evaluated(*model));
    ++tally.accepted;
  } else {
    EXPECT_FALSE(std::get<ReadError>(read).detail.empty());
    ++tally.refused;
  }
}

TEST(Corruption, EveryTruncationIsRefused) {
  for (const auto& [name, model] : golden_models()) {
    const Bytes whole = write_model(model);
    for (std::size_t size = 0; size < whole.size(); ++size) {
      const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
      const auto read = read_model(cut);
      ASSERT_TRUE(std::holds_alternative<ReadError>(read)) << name << " cut to " << size;
      const auto code = std::get<ReadError>(read).code;
      EXPECT_EQ(size < 8 || code == ReadErrorCode::kTruncated, true) << size;
    }
  }
}

TEST(Corruption, EverySingleBitFlipAndEveryByteSetToZeroOrOnesIsRefused) {
  for (const auto& [name, model] : golden_models()) {
    const Bytes whole = write_model(model);
    for (std::size_t i = 0; i < whole.size(); ++i)
      for (int change = 0; change < 10; ++change) {
        Bytes bad = whole;
        bad[i] = change < 8 ? bad[i] ^ std::byte(1U << change) : std::byte(change == 8 ? 0 : 0xFF);
        if (bad == whole) continue;
        EXPECT_TRUE(std::holds_alternative<ReadError>(read_model(bad))) << name << " byte " << i;
      }
  }
}

TEST(Corruption, WithTheChecksumMadeRightAgainNothingUnsoundIsAccepted) {
  Tally tally;
  for (const auto& [name, model] : golden_models()) {
    const Bytes whole = write_model(model);
    for (std::size_t i = 0; i + 16 < whole.size(); ++i)
      for (int change = 0; change < 10; ++change) {
        Bytes bad = whole;
        bad[i] = change < 8 ? bad[i] ^ std::byte(1U << change) : std::byte(change == 8 ? 0 : 0xFF);
        try_one(resealed(std::move(bad)), tally);
      }
  }
  std::printf("%ld refused, %ld accepted and sound\n", tally.refused, tally.accepted);
  EXPECT_GT(tally.refused, 0);
  EXPECT_GT(tally.accepted, 0);  // a digit of a name, the last bit of a length: harmless
}

TEST(Corruption, RandomDamageWithARightChecksumNeverGivesAnUnsoundModel) {
  const char* scale = std::getenv("PLUMB_TEST_SCALE");
  const long count = 20000 * (scale != nullptr ? std::max(1L, std::atol(scale)) : 1L);
  const Bytes whole = write_model(six_axis_model());
  std::uint64_t state = 20260102;
  const auto below = [&](std::size_t n) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    return static_cast<std::size_t>((state >> 33) % n);
  };
  Tally tally;
  for (long k = 0; k < count; ++k) {
    Bytes bad = whole;
    for (std::size_t hits = 1 + below(6); hits > 0; --hits)
      bad[below(whole.size() - 16)] = static_cast<std::byte>(below(256));
    try_one(resealed(std::move(bad)), tally);
  }
  std::printf("%ld cases, seed 20260102: %ld refused, %ld accepted and sound\n", count,
              tally.refused, tally.accepted);
}

}  // namespace
}  // namespace plumb::format
