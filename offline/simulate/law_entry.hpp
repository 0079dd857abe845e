// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "simulate/law.hpp"

/// Words to write the list of laws with: each takes an entry and gives it back changed.
namespace plumb::offline::sim {

using LawMaker = std::unique_ptr<Law> (*)(const HiddenEffect&, const World&);

/// A law of single joints, sized by an angle, called in the library as here.
LawEntry of_joints(const std::string& name, const std::string& line, LawMaker make);

/// A law of the whole arm.
LawEntry of_arm(const std::string& name, const std::string& line, LawEntry::Size size,
                LawEntry::Domain domain, LawMaker make);

/// It can be told these numbers.
LawEntry with_keys(LawEntry entry, std::vector<std::string> keys);

/// It is of no use without these columns.
LawEntry needing(LawEntry entry, LawEntry::Needs needs);

/// What a diagnosis may call it as well, because hardly any data can tell them apart.
LawEntry like(LawEntry entry, std::vector<std::string> others);

/// The library calls it otherwise.
LawEntry called(LawEntry entry, const std::string& library);

LawEntry during(LawEntry entry, LawEntry::Domain domain);

}  // namespace plumb::offline::sim
