// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

/// Column heads of the tables, each said once; `plumb explain` knows every one of them.
namespace plumb::offline::show::head {

inline constexpr const char* kPositionError = "position error [mm]";
inline constexpr const char* kHeldOutError = "held-out error [mm]";
inline constexpr const char* kReadings = "readings";
inline constexpr const char* kMean = "mean";
inline constexpr const char* kInterval = "95 % interval";
inline constexpr const char* kRms = "RMS";
inline constexpr const char* kP95 = "95 %";
inline constexpr const char* kMax = "max";
inline constexpr const char* kParameter = "parameter";
inline constexpr const char* kNominal = "nominal";
inline constexpr const char* kFitted = "fitted";
inline constexpr const char* kChange = "change";
inline constexpr const char* kSigma = "1 sigma";
inline constexpr const char* kEffect = "effect";
inline constexpr const char* kAlone = "alone";
inline constexpr const char* kWithFirst = "with #1";
inline constexpr const char* kSupported = "supported";
inline constexpr const char* kLnBayes = "ln Bayes";
inline constexpr const char* kFall = "fall";
inline constexpr const char* kShare = "share";
inline constexpr const char* kAbsorbed = "absorbed";
inline constexpr const char* kSize = "size";
inline constexpr const char* kRun = "run";
inline constexpr const char* kCreated = "created";
inline constexpr const char* kEffects = "effects";

inline constexpr std::array kAll{kPositionError, kHeldOutError, kReadings, kMean,      kInterval,
                                 kRms,           kP95,          kMax,      kParameter, kNominal,
                                 kFitted,        kChange,       kSigma,    kEffect,    kAlone,
                                 kWithFirst,     kSupported,    kLnBayes,  kFall,      kShare,
                                 kAbsorbed,      kSize,         kRun,      kCreated,   kEffects};

}  // namespace plumb::offline::show::head
