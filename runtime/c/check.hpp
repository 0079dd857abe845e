// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "robot.hpp"

/// Checks of the pointers and struct sizes passed to the C interface. No heap; any thread; fixed
/// cost.
namespace plumb::c {

template <class T>
plumb_result check_pointer(const T* pointer) noexcept {
  if (pointer == nullptr) return PLUMB_NULL;
  return reinterpret_cast<std::uintptr_t>(pointer) % alignof(T) == 0 ? PLUMB_OK : PLUMB_MISALIGNED;
}

inline plumb_result check_robot(const plumb_robot* robot) noexcept {
  const plumb_result pointer = check_pointer(robot);
  if (pointer != PLUMB_OK) return pointer;
  return robot->mark == plumb_robot::kMark ? PLUMB_OK : PLUMB_NOT_A_ROBOT;
}

/// Checks the pointer and the size that the struct states in its first member. `smallest`: the
/// smallest size that any version of T has had.
template <class T>
plumb_result check_struct(const T* pointer, std::size_t smallest = sizeof(T)) noexcept {
  const plumb_result found = check_pointer(pointer);
  if (found != PLUMB_OK) return found;
  return pointer->size >= smallest ? PLUMB_OK : PLUMB_BAD_SIZE;
}

inline plumb_result first_of(plumb_result a, plumb_result b) noexcept {
  return a != PLUMB_OK ? a : b;
}

/// Copies the members that both the caller's version of T and ours have; the others keep their
/// defaults. Precondition: check_struct returned PLUMB_OK.
template <class T>
T copy_in(const T* from) noexcept {
  T out{};
  std::memcpy(&out, from, std::min<std::size_t>(from->size, sizeof(T)));
  return out;
}

/// Copies `value` to the caller's struct, but not beyond the size stated there, which is kept.
template <class T>
void copy_out(T value, T* to) noexcept {
  value.size = to->size;
  std::memcpy(to, &value, std::min<std::size_t>(value.size, sizeof(T)));
}

}  // namespace plumb::c
