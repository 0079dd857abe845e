// SPDX-License-Identifier: Apache-2.0
// A copy of a session in a record is read whole or not at all.
#include "rt/session_lines.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "rt/record_line.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::drivers::rt {
namespace {

using Read = SessionReader::Read;

std::vector<std::byte> copy_of(std::size_t size) {
  tests::Random random(size + 1);
  std::vector<std::byte> out(size);
  for (std::byte& one : out) one = static_cast<std::byte>(random.below(256));
  return out;
}

std::vector<CanFrame> frames_of(const std::string& text) {
  std::vector<CanFrame> out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const auto read = parse_line(line);
    EXPECT_TRUE(read.has_value()) << line;
    if (read) out.push_back(read->frame);
  }
  return out;
}

std::vector<CanFrame> frames(std::size_t size) {
  return frames_of(session_lines(copy_of(size), 7, 123456789012, 1700000000123456000));
}

/// Whether the reader ever says that a copy is complete.
bool completes(const std::vector<CanFrame>& all) {
  SessionReader reader;
  bool out = false;
  for (const CanFrame& frame : all) out = reader.take(frame) == Read::kComplete || out;
  return out;
}

TEST(SessionLines, WhatIsWrittenIsReadAgain) {
  for (const std::size_t size : {1U, 63U, 64U, 65U, 640U}) {
    SessionReader reader;
    const auto all = frames(size);
    for (std::size_t i = 0; i < all.size(); ++i)
      EXPECT_EQ(reader.take(all[i]), i + 1 < all.size() ? Read::kGoesOn : Read::kComplete) << size;
    EXPECT_EQ(reader.session().copy, copy_of(size));
    EXPECT_EQ(reader.session().model, 7U);
    EXPECT_EQ(reader.session().cycles, 123456789012U);
    EXPECT_NEAR(static_cast<double>(reader.session().time_ns - 1700000000123456000), 0.0, 1000.0);
  }
}

TEST(SessionLines, WithoutAnyOneOfItsFramesACopyIsNotComplete) {
  const auto all = frames(300);
  for (std::size_t gone = 0; gone < all.size(); ++gone) {
    auto some = all;
    some.erase(some.begin() + static_cast<std::ptrdiff_t>(gone));
    EXPECT_FALSE(completes(some)) << gone;
  }
}

TEST(SessionLines, TwiceOrInAnotherOrderFramesAreDamaged) {
  const auto all = frames(300);
  for (std::size_t i = 1; i + 1 < all.size(); ++i) {
    auto twice = all;
    twice.insert(twice.begin() + static_cast<std::ptrdiff_t>(i), all[i]);
    EXPECT_FALSE(completes(twice)) << i;
    auto other = all;
    std::swap(other[i], other[i + 1]);
    EXPECT_FALSE(completes(other)) << i;
  }
}

TEST(SessionLines, AnyBitThatIsWrongIsFound) {
  const auto all = frames(130);
  tests::Random random(3);
  for (std::size_t i = 1; i < all.size(); ++i) {
    auto wrong = all;
    wrong[i].data[static_cast<std::size_t>(random.below(wrong[i].length))] ^= 1;
    EXPECT_FALSE(completes(wrong)) << i;
  }
}

TEST(SessionLines, AProgramWithAnotherLayoutIsForeignUntilTheNextHead) {
  auto other = frames(130);
  other[0].data[0] ^= 1;
  SessionReader reader;
  EXPECT_EQ(reader.take(other[0]), Read::kForeign);
  for (std::size_t i = 1; i < other.size(); ++i) EXPECT_EQ(reader.take(other[i]), Read::kGoesOn);
  Read last = Read::kGoesOn;
  for (const CanFrame& frame : frames(130)) last = reader.take(frame);
  EXPECT_EQ(last, Read::kComplete);
}

TEST(SessionLines, AfterADamagedCopyTheNextOneIsRead) {
  auto all = frames(200);
  all.erase(all.begin() + 2);
  for (const CanFrame& frame : frames(200)) all.push_back(frame);
  EXPECT_TRUE(completes(all));
}

/// A head may claim any size: no more is kept than a session has.
TEST(SessionLines, MoreThanASessionIsNeverKept) {
  auto all = frames(130);
  for (std::size_t at = 28; at < 32; ++at) all[0].data[at] = 0xff;
  SessionReader reader;
  reader.take(all[0]);
  CanFrame part = all[1];
  Read last = Read::kGoesOn;
  for (std::uint32_t id = 1; id < 100'000 && last == Read::kGoesOn; ++id) {
    part.id = id;
    last = reader.take(part);
  }
  EXPECT_EQ(last, Read::kDamaged);
}

}  // namespace
}  // namespace plumb::drivers::rt
