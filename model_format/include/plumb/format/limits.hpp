// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Static bounds of a model. The reader refuses a model that exceeds them, `plumb compile` never
/// writes one, and the cost of the cycle follows from them. They are stated only here.
namespace plumb::format {

inline constexpr int kMaxJoints = 9;
inline constexpr int kMaxCouplings = kMaxJoints * (kMaxJoints - 1) / 2;
inline constexpr double kMaxCouplingRatio = 10.0;
inline constexpr int kMaxEffects = 64;
inline constexpr int kMaxSeriesWaves = 64;  // of one joint
inline constexpr int kMaxEffectParameters = 2 * kMaxSeriesWaves * kMaxJoints;
inline constexpr int kMaxEffectConstants = 64;
inline constexpr int kMaxFormulaCode = 128;  // instructions
inline constexpr int kMaxFormulaDepth = 24;  // numbers on the stack of a formula
inline constexpr int kMaxFormulaLiterals = 64;
inline constexpr int kMaxFormulaParameters = 32;
inline constexpr int kMaxFormulaText = 1024;      // bytes
inline constexpr double kMaxFormulaMotion = 1.0;  // [m] or [rad]; larger values are rejected
inline constexpr int kMaxTemperatures = 8;        // sensors
inline constexpr int kTreeAxes = 3;               // x, y, z of the base frame
inline constexpr int kMaxTreeLeaves = 4096;       // per axis
inline constexpr int kMaxTreeDepth = 64;
inline constexpr int kMaxActiveLeaves = 64;  // leaves that contribute to one blended value
inline constexpr int kMaxLeafTerms = 1 + kMaxJoints + kMaxJoints * (kMaxJoints + 1) / 2;
inline constexpr int kMaxParameters = 160;  // fitted parameters with a covariance
inline constexpr int kMaxFileBytes = 16 << 20;

}  // namespace plumb::format
