// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <thread>

#include "plumb/drivers/bus_message.hpp"
#include "plumb/drivers/mailbox.hpp"
#include "tests/random_numbers.hpp"

using namespace plumb::drivers;

namespace {

struct Pair {
  std::uint64_t number = 0;
  std::array<std::uint64_t, 14> copies{};  // as big as a message
};

Pair pair_of(std::uint64_t number) {
  Pair out{.number = number};
  out.copies.fill(~number);
  return out;
}

}  // namespace

TEST(Mailbox, IsEmptyUntilSomethingIsPut) {
  Mailbox<int> box;
  int out = 5;
  EXPECT_FALSE(box.take(out));
  EXPECT_EQ(out, 5);
}

TEST(Mailbox, GivesTheNewestOnce) {
  Mailbox<int> box;
  int out = 0;
  for (int value : {1, 2, 3}) box.put(value);
  ASSERT_TRUE(box.take(out));
  EXPECT_EQ(out, 3);
  EXPECT_FALSE(box.take(out));
  box.put(4);
  ASSERT_TRUE(box.take(out));
  EXPECT_EQ(out, 4);
}

/// Under the thread sanitizer also: no access races.
TEST(Mailbox, NeverGivesAHalfAnOldOrARepeatedValueWhileItIsWritten) {
  const auto count = static_cast<std::uint64_t>(plumb::tests::scaled(300'000));
  Mailbox<Pair> box;
  std::thread writer([&] {
    for (std::uint64_t i = 1; i <= count; ++i) box.put(pair_of(i));
  });
  std::uint64_t last = 0, taken = 0, wrong = 0;
  while (last < count) {
    Pair out;
    if (!box.take(out)) {
      std::this_thread::yield();
      continue;
    }
    ++taken;
    if (out.number <= last) ++wrong;
    for (std::uint64_t copy : out.copies)
      if (copy != ~out.number) ++wrong;
    last = out.number;
  }
  writer.join();
  EXPECT_EQ(wrong, 0U);
  std::printf("%llu put, %llu taken\n", static_cast<unsigned long long>(count),
              static_cast<unsigned long long>(taken));
}
