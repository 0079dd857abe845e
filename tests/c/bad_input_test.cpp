// SPDX-License-Identifier: Apache-2.0
// Every field of every struct of the C interface, set to what it should not be.
#include <cstddef>
#include <cstring>
#include <limits>

#include "tests/c/support.hpp"

namespace plumb::tests {
namespace {

struct Field {
  const char* name;
  std::size_t offset;
  std::size_t bytes;
};

#define PLUMB_FIELD(type, member) \
  Field { #member, offsetof(type, member), sizeof(type::member) }

/// The numbers of an input; size, arrived and now_ns have tests of their own.
const Field kInputNumbers[] = {
    PLUMB_FIELD(plumb_input, X_BD),          PLUMB_FIELD(plumb_input, q_measured),
    PLUMB_FIELD(plumb_input, q_commanded),   PLUMB_FIELD(plumb_input, payload_kg),
    PLUMB_FIELD(plumb_input, payload_com_m), PLUMB_FIELD(plumb_input, temperature_degC),
    PLUMB_FIELD(plumb_input, time_s)};

const double kWild[] = {std::numeric_limits<double>::quiet_NaN(),
                        std::numeric_limits<double>::signaling_NaN(),
                        HUGE_VAL,
                        -HUGE_VAL,
                        std::numeric_limits<double>::max(),
                        std::numeric_limits<double>::lowest(),
                        1e308,
                        -1e155,
                        1e20,
                        std::numeric_limits<double>::denorm_min(),
                        -1e-310,
                        std::numeric_limits<double>::min(),
                        0.0,
                        -0.0};

constexpr std::uint32_t kEverything =
    PLUMB_TARGET | PLUMB_MEASURED | PLUMB_COMMANDED | PLUMB_PAYLOAD | PLUMB_TIME | 0xff00U;

TEST(BadInput, OfTheTableCoversTheWholeInput) {
  std::size_t bytes = offsetof(plumb_input, X_BD);
  for (const Field& field : kInputNumbers) {
    EXPECT_EQ(field.offset, bytes) << field.name;
    bytes += field.bytes;
  }
  EXPECT_EQ(bytes, sizeof(plumb_input));
}

/// A target that the guard takes for a pose is what the output lies on.
bool poses(const plumb_pose& X) {
  for (const double p : X.p_m)
    if (!std::isfinite(p)) return false;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      double product = 0.0;
      for (int k = 0; k < 3; ++k) product += X.R[3 * k + i] * X.R[3 * k + j];
      if (!(std::abs(product - (i == j ? 1.0 : 0.0)) <= 1e-6)) return false;
    }
  return true;
}

class Bench {
 public:
  /// One cycle, watched.
  void cycle(plumb_input in) {
    in.now_ns = now_ += kTick_ns;
    plumb_output out = blank_output();
    ASSERT_EQ(plumb_correct(robot_.get(), &in, &out), PLUMB_OK);
    Laws::finite(out);
    const bool target = (in.arrived & PLUMB_TARGET) != 0;
    if (target && !poses(in.X_BD)) {
      ASSERT_EQ(out.status, PLUMB_STATUS_NOT_FINITE);
      return;  // held
    }
    const bool near = std::abs(in.X_BD.p_m[0]) < 10.0 && std::abs(in.X_BD.p_m[1]) < 10.0 &&
                      std::abs(in.X_BD.p_m[2]) < 10.0;
    near ? laws_.hold(out, in.X_BD) : laws_.look_away();
    last_ = out;
  }
  const plumb_output& last() const { return last_; }

 private:
  Robot robot_;
  Laws laws_;
  plumb_output last_{};
  std::int64_t now_ = 0;
};

void set(plumb_input& in, std::size_t offset, double value) {
  std::memcpy(reinterpret_cast<char*>(&in) + offset, &value, sizeof value);
}

TEST(BadInput, InEveryNumberLeavesTheOutputFiniteBoundedAndSlow) {
  Bench bench;
  long cases = 0;
  for (const Field& field : kInputNumbers)
    for (std::size_t at = field.offset; at < field.offset + field.bytes; at += sizeof(double))
      for (const double value : kWild) {
        for (int k = 0; k < 5; ++k) bench.cycle(sound_input());
        plumb_input bad = sound_input();
        bad.arrived = kEverything;
        set(bad, at, value);
        for (int k = 0; k < 5; ++k) bench.cycle(bad);
        ++cases;
        ASSERT_FALSE(HasFatalFailure())
            << field.name << " + " << at - field.offset << ": " << value;
      }
  for (int k = 0; k < 300; ++k) bench.cycle(sound_input());
  EXPECT_GE(bench.last().status, 0);
  std::printf("%ld cases\n", cases);
}

TEST(BadInput, InAllNumbersAtOnceFromTheBeginningSendsNothing) {
  for (const double value : kWild) {
    Bench bench;
    plumb_input bad = sound_input();
    bad.arrived = kEverything;
    for (std::size_t at = offsetof(plumb_input, X_BD); at < sizeof bad; at += sizeof(double))
      set(bad, at, value);
    for (int k = 0; k < 50; ++k) bench.cycle(bad);
    EXPECT_EQ(bench.last().has_output, 0) << value;
    for (int k = 0; k < 50; ++k) bench.cycle(sound_input());
    EXPECT_EQ(bench.last().has_output, 1) << value;
  }
}

TEST(BadInput, ThatIsRefusedFromTheBeginningSendsNothing) {
  Bench bench;
  plumb_input far = sound_input();
  far.q_measured[2] += 0.5;
  for (int k = 0; k < 50; ++k) bench.cycle(far);
  EXPECT_EQ(bench.last().status, PLUMB_STATUS_FAR_FROM_SEED);
  EXPECT_EQ(bench.last().has_output, 0);
  bench.cycle(sound_input());
  EXPECT_EQ(bench.last().has_output, 1);
}

TEST(BadInput, InArrivedIsOnlyWhatItsKnownBitsSay) {
  Bench bench;
  for (unsigned bit = 0; bit < 32; ++bit) {
    plumb_input in = sound_input();
    in.arrived = UINT32_C(1) << bit;
    for (int k = 0; k < 3; ++k) bench.cycle(in);
    in.arrived = ~in.arrived;
    for (int k = 0; k < 3; ++k) bench.cycle(in);
    ASSERT_FALSE(HasFatalFailure()) << bit;
  }
}

TEST(BadInput, OfTheClockIsHarmless) {
  const Robot robot;
  Laws laws;
  plumb_input in = sound_input();
  const std::int64_t times[] = {0,         1,          -1,        INT64_MAX, INT64_MIN,
                                INT64_MAX, 10'000'000, 0,         4'000'000, 10'004'000'000,
                                8'000'000, -1,         INT64_MAX, 12'000'000};
  plumb_output out = blank_output();
  for (int round = 0; round < 100; ++round)
    for (const std::int64_t now : times) {
      in.now_ns = now;
      ASSERT_EQ(plumb_correct(robot.get(), &in, &out), PLUMB_OK);
      laws.hold(out, in.X_BD);
      ASSERT_GE(out.status, 0);
      ASSERT_FALSE(HasFatalFailure()) << now;
    }
}

TEST(BadInput, AfterAnOverrunOfTenSecondsIsHarmless) {
  const Robot robot;
  Laws laws;
  plumb_input in = sound_input();
  plumb_output out = blank_output();
  for (int k = 0; k < 300; ++k) {
    in.now_ns += k % 50 == 49 ? 10'000'000'000 : kTick_ns;
    ASSERT_EQ(plumb_correct(robot.get(), &in, &out), PLUMB_OK);
    laws.hold(out, in.X_BD);
  }
}

template <class T>
T* misaligned(T& at, std::size_t by) {
  return reinterpret_cast<T*>(reinterpret_cast<std::uintptr_t>(&at) + by);
}

TEST(BadPointer, ToAnythingThatIsNullIsNamed) {
  const Robot robot;
  plumb_input in = sound_input();
  plumb_output out = blank_output();
  plumb_joints joints{sizeof(plumb_joints), 0, {}};
  plumb_prediction prediction{};
  prediction.size = sizeof prediction;
  plumb_counters counters{};
  counters.size = sizeof counters;
  plumb_robot* loaded = nullptr;
  plumb_robot* const r = robot.get();
  const char byte = 0;
  EXPECT_EQ(plumb_correct(nullptr, &in, &out), PLUMB_NULL);
  EXPECT_EQ(plumb_correct(r, nullptr, &out), PLUMB_NULL);
  EXPECT_EQ(plumb_correct(r, &in, nullptr), PLUMB_NULL);
  EXPECT_EQ(plumb_predict(nullptr, &joints, &prediction), PLUMB_NULL);
  EXPECT_EQ(plumb_predict(r, nullptr, &prediction), PLUMB_NULL);
  EXPECT_EQ(plumb_predict(r, &joints, nullptr), PLUMB_NULL);
  EXPECT_EQ(plumb_read_counters(nullptr, &counters), PLUMB_NULL);
  EXPECT_EQ(plumb_read_counters(r, nullptr), PLUMB_NULL);
  EXPECT_EQ(plumb_enable(nullptr, 1), PLUMB_NULL);
  EXPECT_EQ(plumb_input_init(nullptr), PLUMB_NULL);
  EXPECT_EQ(plumb_load_file(nullptr, nullptr, &loaded, nullptr, 0), PLUMB_NULL);
  EXPECT_EQ(plumb_load_file("x", nullptr, nullptr, nullptr, 0), PLUMB_NULL);
  EXPECT_EQ(plumb_load_bytes(nullptr, 10, nullptr, &loaded, nullptr, 0), PLUMB_NULL);
  EXPECT_EQ(plumb_load_bytes(&byte, 1, nullptr, nullptr, nullptr, 0), PLUMB_NULL);
  EXPECT_EQ(plumb_swap_file(nullptr, "x", nullptr, 0), PLUMB_NULL);
  EXPECT_EQ(plumb_swap_file(r, nullptr, nullptr, 0), PLUMB_NULL);
  EXPECT_EQ(plumb_swap_bytes(nullptr, &byte, 1, nullptr, 0), PLUMB_NULL);
  EXPECT_EQ(plumb_swap_bytes(r, nullptr, 1, nullptr, 0), PLUMB_NULL);
  EXPECT_EQ(plumb_collect(nullptr), PLUMB_NULL);
  EXPECT_EQ(plumb_unload(nullptr), PLUMB_OK);
  EXPECT_EQ(plumb_joint_count(nullptr), 0);
  EXPECT_STREQ(plumb_serial(nullptr), "");
  EXPECT_EQ(plumb_temperature_name(nullptr, 0), nullptr);
}

TEST(BadPointer, ThatIsMisalignedIsNamed) {
  const Robot robot;
  plumb_input in[2] = {sound_input(), sound_input()};
  plumb_output out[2] = {blank_output(), blank_output()};
  plumb_joints joints[2]{};
  plumb_prediction prediction[2]{};
  plumb_counters counters[2]{};
  plumb_robot* loaded[2]{};
  plumb_robot* const r = robot.get();
  for (std::size_t by = 1; by < 8; ++by) {
    EXPECT_EQ(plumb_correct(r, misaligned(in[0], by), &out[0]), PLUMB_MISALIGNED);
    EXPECT_EQ(plumb_correct(r, &in[0], misaligned(out[0], by)), PLUMB_MISALIGNED);
    EXPECT_EQ(plumb_correct(misaligned(*r, by), &in[0], &out[0]), PLUMB_MISALIGNED);
    EXPECT_EQ(plumb_predict(r, misaligned(joints[0], by), &prediction[0]), PLUMB_BAD_SIZE);
    prediction[0].size = sizeof prediction[0];
    EXPECT_EQ(plumb_predict(r, misaligned(joints[0], by), &prediction[0]), PLUMB_MISALIGNED);
    prediction[0].size = 0;
    EXPECT_EQ(plumb_predict(r, &joints[0], misaligned(prediction[0], by)), PLUMB_MISALIGNED);
    EXPECT_EQ(plumb_read_counters(r, misaligned(counters[0], by)), PLUMB_MISALIGNED);
    EXPECT_EQ(plumb_input_init(misaligned(in[0], by)), PLUMB_MISALIGNED);
    EXPECT_EQ(plumb_load_file("x", nullptr, misaligned(loaded[0], by), nullptr, 0),
              PLUMB_MISALIGNED);
    EXPECT_EQ(plumb_swap_file(misaligned(*r, by), "x", nullptr, 0), PLUMB_MISALIGNED);
    EXPECT_EQ(plumb_collect(misaligned(*r, by)), PLUMB_MISALIGNED);
    EXPECT_EQ(plumb_enable(misaligned(*r, by), 1), PLUMB_MISALIGNED);
    EXPECT_EQ(plumb_unload(misaligned(*r, by)), PLUMB_MISALIGNED);
    EXPECT_EQ(plumb_joint_count(misaligned(*r, by)), 0);
  }
}

TEST(BadPointer, ToSomethingElseThanARobotIsNamed) {
  alignas(64) unsigned char other[1024]{};
  auto* const robot = reinterpret_cast<plumb_robot*>(other);
  plumb_input in = sound_input();
  plumb_output out = blank_output();
  EXPECT_EQ(plumb_correct(robot, &in, &out), PLUMB_NOT_A_ROBOT);
  EXPECT_EQ(plumb_unload(robot), PLUMB_NOT_A_ROBOT);
  EXPECT_EQ(plumb_collect(robot), PLUMB_NOT_A_ROBOT);
  EXPECT_STREQ(plumb_serial(robot), "");
}

TEST(BadPointer, LeavesAnOutputThatSaysSendNothing) {
  plumb_output out;
  std::memset(&out, 0xff, sizeof out);
  out.size = sizeof out;
  const plumb_input in = sound_input();
  EXPECT_EQ(plumb_correct(nullptr, &in, &out), PLUMB_NULL);
  Laws::finite(out);
  EXPECT_EQ(out.has_output, 0);
  EXPECT_LT(out.status, 0);
}

TEST(BadSize, OfAStructIsRefusedAndNothingIsWrittenBeyondIt) {
  const Robot robot;
  const std::uint32_t full = sizeof(plumb_output);
  for (const std::uint32_t size : {0U, 1U, 4U, full - 1, full, full + 8, UINT32_MAX}) {
    struct {
      std::uint64_t before;
      plumb_output out;
      std::uint64_t behind;
    } room{0xabababababababab, {}, 0xcdcdcdcdcdcdcdcd};
    room.out.size = size;
    const plumb_input in = sound_input();
    EXPECT_EQ(plumb_correct(robot.get(), &in, &room.out), size < full ? PLUMB_BAD_SIZE : PLUMB_OK);
    EXPECT_EQ(room.out.size, size);
    EXPECT_EQ(room.before, 0xabababababababab);
    EXPECT_EQ(room.behind, 0xcdcdcdcdcdcdcdcd);
    if (size < full) {
      EXPECT_EQ(room.out.X_BC.R[0], 0.0);
    }
  }
  plumb_input in = sound_input();
  plumb_output out = blank_output();
  for (const std::uint32_t size : {0U, 1U, static_cast<std::uint32_t>(sizeof in - 1)}) {
    in.size = size;
    EXPECT_EQ(plumb_correct(robot.get(), &in, &out), PLUMB_BAD_SIZE);
    EXPECT_EQ(out.has_output, 0);
  }
  for (const std::uint32_t size : {static_cast<std::uint32_t>(sizeof in + 8), UINT32_MAX}) {
    in.size = size;
    EXPECT_EQ(plumb_correct(robot.get(), &in, &out), PLUMB_OK);
  }
}

TEST(BadOverlap, OfInputAndOutputGivesTheSameOutput) {
  for (std::size_t shift = 0; shift <= sizeof(plumb_input); shift += 8) {
    const Robot apart, together;
    plumb_input in = sound_input();
    plumb_output expected = blank_output();
    alignas(8) unsigned char room[sizeof(plumb_input) * 2 + sizeof(plumb_output)];
    std::memcpy(room, &in, sizeof in);
    auto* const input = reinterpret_cast<plumb_input*>(room);
    auto* const output = reinterpret_cast<plumb_output*>(room + shift);
    // The first member of the output may lie in a number of the input.
    output->size = sizeof(plumb_output);
    if (shift == 0) input->size = sizeof(plumb_input);
    std::memcpy(&in, room, sizeof in);
    ASSERT_EQ(plumb_correct(apart.get(), &in, &expected), PLUMB_OK) << shift;
    ASSERT_EQ(plumb_correct(together.get(), input, output), PLUMB_OK) << shift;
    expected.size = output->size;
    EXPECT_EQ(std::memcmp(output, &expected, sizeof expected), 0) << shift;
  }
}

TEST(BadPrediction, IsFiniteWhateverTheJointsAre) {
  const Robot robot;
  for (int joint = 0; joint < PLUMB_MAX_JOINTS; ++joint)
    for (const double value : kWild) {
      plumb_joints joints{sizeof(plumb_joints), 0, {}};
      std::copy_n(home(), PLUMB_MAX_JOINTS, joints.q);
      joints.q[joint] = value;
      plumb_prediction out{};
      out.size = sizeof out;
      ASSERT_EQ(plumb_predict(robot.get(), &joints, &out), PLUMB_OK);
      const bool usable = joint >= 6 || std::abs(value) <= 1e4;
      EXPECT_EQ(out.status >= 0, usable) << joint << " " << value;
      for (const double p : out.X_BT.p_m) ASSERT_TRUE(std::isfinite(p));
      for (const double r : out.X_BT.R) ASSERT_TRUE(std::isfinite(r));
      for (const double t : out.tree_m) ASSERT_TRUE(std::isfinite(t));
    }
}

}  // namespace
}  // namespace plumb::tests
