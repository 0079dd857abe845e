// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include "diagnose/diagnosis.hpp"

namespace plumb::offline {

/// Whether the error on unseen poses falls, in the digits that are shown.
bool falls(double before_m, double after_m);

/// Whether the first candidate may be another effect, or a slow motion, instead.
bool may_be_another(const Diagnosis& diagnosis);

/// Whether an effect is the first candidate or one of what it may be instead.
bool is_either(const Diagnosis& diagnosis, const EffectEntry& entry);

/// Whether another effect, known by its key, explains these poses nearly as well as the first
/// candidate: the evidence hardly sets them apart.
bool is_near_rival(const Cell& cell, const Diagnosis& diagnosis, const std::string& key);

/// The first that does nearly what the first candidate does, and that the evidence hardly sets
/// apart; null if nothing is near.
const Candidate* near_rival(const Cell& cell, const Diagnosis& diagnosis);

/// A direction of gravity as cell.toml writes it: "[0, 0, -9.81]".
std::string gravity_text(const std::array<double, 3>& gravity);

/// The finding at the start, and with `apply` at the end, each in one sentence.
std::string verdict_text(const Cell& cell, const Diagnosis& diagnosis);
std::string verdict_after_text(const Cell& cell, const Diagnosis& diagnosis);

}  // namespace plumb::offline
