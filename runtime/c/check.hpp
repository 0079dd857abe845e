// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "robot.hpp"

/// What the C interface finds out about pointers and sizes. No heap; any thread; fixed cost.
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

/// Structs begin with their size; no version of T is smaller than `smallest`.
template <class T>
plumb_result check_struct(const T* pointer, std::size_t smallest = sizeof(T)) noexcept {
  const plumb_result found = check_pointer(pointer);
  if (found != PLUMB_OK) return found;
  return pointer->size >= smallest ? PLUMB_OK : PLUMB_BAD_SIZE;
}

inline plumb_result first_of(plumb_result a, plumb_result b) noexcept {
  return a != PLUMB_OK ? a : b;
}

/// The caller's struct as far as both sides know it. Precondition: check_struct found nothing.
template <class T>
T copy_in(const T* from) noexcept {
  T out{};
  std::memcpy(&out, from, std::min<std::size_t>(from->size, sizeof(T)));
  return out;
}

/// Writes no further than the caller's size, which stays what it was.
template <class T>
void copy_out(T value, T* to) noexcept {
  value.size = to->size;
  std::memcpy(to, &value, std::min<std::size_t>(value.size, sizeof(T)));
}

}  // namespace plumb::c
