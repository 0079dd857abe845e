// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "simulate/law.hpp"

/// Functions with which the list of laws is written. Most take an entry and return it with a
/// change.
namespace plumb::offline::sim {

using LawMaker = std::unique_ptr<Law> (*)(const HiddenEffect&, const World&);

/// A law of single joints whose size is an angle and whose name in the library is the same.
LawEntry of_joints(const std::string& name, const std::string& line, LawMaker make);

/// A law of the whole arm.
LawEntry of_arm(const std::string& name, const std::string& line, LawEntry::Size size,
                LawEntry::Domain domain, LawMaker make);

/// Adds the numbers that the user can set.
LawEntry with_keys(LawEntry entry, std::vector<std::string> keys);

/// Adds the columns that the effect needs.
LawEntry needing(LawEntry entry, LawEntry::Needs needs);

/// Adds other effects that a diagnosis may name instead, because hardly any data can tell them
/// apart.
LawEntry like(LawEntry entry, std::vector<std::string> others);

/// Sets a different name of the effect in the library.
LawEntry called(LawEntry entry, const std::string& library);

/// Sets whether the effect acts on the robot or only while something is measured.
LawEntry during(LawEntry entry, LawEntry::Domain domain);

}  // namespace plumb::offline::sim
