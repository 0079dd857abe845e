// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

namespace plumb::bare_metal {

/// Counts the instructions of what it is given, exactly, on an emulator with virtual time: SysTick
/// runs at 25 MHz, a tick is 40 ns, and `-icount shift=7` lets an instruction take 128 ns. On a
/// real board it counts cycles in an odd unit. At most five million instructions a call.
class InstructionMeter {
 public:
  InstructionMeter() noexcept {
    at(kReload) = kMask;
    at(kValue) = 0;
    at(kControl) = 5;  // on, from the processor's clock
    empty_ = count([] {});
  }

  template <class F>
  void operator()(F call) noexcept {
    const std::uint32_t instructions = count(call) - empty_;
    least_ = std::min(least_, instructions);
    most_ = std::max(most_, instructions);
    total_ += instructions;
    ++calls_;
  }

  std::uint32_t least() const noexcept { return least_; }
  std::uint32_t most() const noexcept { return most_; }
  std::uint64_t mean() const noexcept { return total_ / calls_; }

  /// Whether most and least differ by no more than this share of the mean.
  bool within_percent(std::uint64_t share) const noexcept {
    return (most_ - least_) * std::uint64_t{100} <= share * mean();
  }

 private:
  static constexpr std::uint32_t kControl = 0xE000E010, kReload = 0xE000E014, kValue = 0xE000E018;
  static constexpr std::uint32_t kMask = 0xFFFFFF;
  static constexpr std::uint64_t kTick_ns = 40, kInstruction_ns = 128;

  static volatile std::uint32_t& at(std::uint32_t address) noexcept {
    return *reinterpret_cast<volatile std::uint32_t*>(address);
  }

  template <class F>
  [[gnu::noinline]] static std::uint32_t count(F call) noexcept {
    const std::uint32_t begin = at(kValue);
    __asm__ volatile("" ::: "memory");
    call();
    __asm__ volatile("" ::: "memory");
    const std::uint64_t ticks = (begin - at(kValue)) & kMask;
    return static_cast<std::uint32_t>((ticks * kTick_ns + kInstruction_ns / 2) / kInstruction_ns);
  }

  std::uint32_t empty_ = 0;
  std::uint32_t least_ = ~0U;
  std::uint32_t most_ = 0;
  std::uint64_t total_ = 0;
  std::uint64_t calls_ = 0;
};

}  // namespace plumb::bare_metal
