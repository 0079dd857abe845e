// SPDX-License-Identifier: Apache-2.0
#include "simulate/random.hpp"

#include <bit>
#include <cmath>
#include <numbers>

namespace plumb::offline::sim {
namespace {

// FNV-1a, 64 bit.
std::uint64_t hash(std::string_view text) {
  std::uint64_t h = 0xcbf29ce484222325ULL;
  for (const char c : text) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return h;
}

std::uint64_t splitmix64(std::uint64_t& x) {
  x += 0x9e3779b97f4a7c15ULL;
  std::uint64_t z = x;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

}  // namespace

Random::Random(std::uint64_t seed, std::string_view purpose) : state_{} {
  std::uint64_t x = splitmix64(seed) ^ hash(purpose);
  for (auto& word : state_) word = splitmix64(x);
}

std::uint64_t Random::bits() {
  const std::uint64_t result = std::rotl(state_[0] + state_[3], 23) + state_[0];
  const std::uint64_t t = state_[1] << 17;
  state_[2] ^= state_[0];
  state_[3] ^= state_[1];
  state_[1] ^= state_[2];
  state_[0] ^= state_[3];
  state_[2] ^= t;
  state_[3] = std::rotl(state_[3], 45);
  return result;
}

double Random::uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

double Random::uniform(double low, double high) { return low + (high - low) * uniform(); }

int Random::below(int n) { return static_cast<int>(uniform() * n); }

double Random::normal() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  const double angle = 2.0 * std::numbers::pi * uniform();
  spare_ = radius * std::sin(angle);
  has_spare_ = true;
  return radius * std::cos(angle);
}

Eigen::Vector3d Random::direction() {
  Eigen::Vector3d v;
  for (int k = 0; k < 3; ++k) v(k) = normal();
  return v.normalized();
}

Eigen::Quaterniond Random::orientation() {
  Eigen::Vector4d v;
  for (int k = 0; k < 4; ++k) v(k) = normal();
  v.normalize();
  return {std::abs(v(0)), v(1), v(2), v(3)};
}

}  // namespace plumb::offline::sim
