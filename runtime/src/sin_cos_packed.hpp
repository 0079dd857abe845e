// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "lane_choices.hpp"
#include "lanes.hpp"

/// Inline sine and cosine of one number or of a register; portable::sin_cos uses them, too.
// Polynomial coefficients: the minimax sets of FDLIBM 5.3 [Sun Microsystems 1993], which state an
// approximation error below 2^-57 on the reduced intervals.
namespace plumb::portable {

/// For |x| < 2^51, x + kShift has no fractional bits: its last bits are the integer nearest to x
/// (ties to even) in two's complement.
inline constexpr double kShift = 0x1.8p52;

/// Real: double, or several of them.
template <class Real>
struct Reduced {
  Real value;    // in [-pi/4, pi/4]
  Real tail;     // value + tail is the remainder to about 100 bits
  Real shifted;  // kShift + quadrant
};

/// Cody-Waite reduction: pi/2 is split into two parts of 33 bits and a third, so that the first two
/// products are exact.
template <class Real>
void reduce(const Real& x, Reduced<Real>& out) {
  constexpr double kTwoOverPi = 6.36619772367581382433e-01;
  constexpr double kPart1 = 1.57079632673412561417e+00;
  constexpr double kPart2 = 6.07710050630396597660e-11;
  constexpr double kPart3 = 2.02226624879595063154e-21;
  out.shifted = x * kTwoOverPi + kShift;
  const Real n = out.shifted - kShift;
  const Real first = x - n * kPart1;
  const Real second = n * kPart2;
  const Real rest = first - second;
  const Real lost = (first - rest) - second - n * kPart3;
  out.value = rest + lost;
  out.tail = (rest - out.value) + lost;
}

template <class Real>
void sine(const Real& x, const Real& tail, Real& out) {
  const Real z = x * x;
  const Real v = z * x;
  const Real p = 8.33333333332248946124e-03 +
                 z * (-1.98412698298579493134e-04 +
                      z * (2.75573137070700676789e-06 +
                           z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)));
  out = x - ((z * (0.5 * tail - v * p) - tail) - v * -1.66666666666666324348e-01);
}

template <class Real>
void cosine(const Real& x, const Real& tail, Real& out) {
  const Real z = x * x;
  const Real p =
      z * (4.16666666666666019037e-02 +
           z * (-1.38888888888741095749e-03 +
                z * (2.48015872894767294178e-05 +
                     z * (-2.75573143513906633035e-07 +
                          z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11)))));
  const Real half = 0.5 * z;
  const Real w = 1.0 - half;
  out = w + (((1.0 - w) - half) + (z * p - x * tail));
}

inline constexpr double kLargestAngle = 1e5;

/// x, or NaN where |x| is too large; all that is computed from it is then NaN, too.
inline Packed known_angle(const Packed& x) {
  return reinterpret_cast<Packed>(reinterpret_cast<PackedBits>(x) |
                                  above(magnitude(x), kLargestAngle));
}

/// The quadrant decides whether sine and cosine change places and signs. This is done with bit
/// masks, so a lane costs the same whatever it contains. Half a turn negates both; a further
/// quarter turn changes (s, c) into (c, -s).
inline void sin_cos_packed(const Packed& x, Packed& sin_out, Packed& cos_out) {
  Reduced<Packed> r;
  reduce(known_angle(x), r);
  Packed s, c;
  sine(r.value, r.tail, s);
  cosine(r.value, r.tail, c);
  const PackedBits quadrant = reinterpret_cast<PackedBits>(r.shifted);
  const PackedBits half_turn = reinterpret_cast<PackedBits>(
      common_bits(reinterpret_cast<Packed>(quadrant << 62), packed(-0.0)));
  const Packed s_here = reinterpret_cast<Packed>(reinterpret_cast<PackedBits>(s) ^ half_turn);
  const Packed c_here = reinterpret_cast<Packed>(reinterpret_cast<PackedBits>(c) ^ half_turn);
  sin_out = by_parity(quadrant, s_here, c_here);
  cos_out = by_parity(quadrant, c_here, -s_here);
}

}  // namespace plumb::portable
