// SPDX-License-Identifier: Apache-2.0
#include "simulate/law_entry.hpp"

namespace plumb::offline::sim {

LawEntry of_joints(const std::string& name, const std::string& line, LawMaker make) {
  LawEntry out;
  out.name = out.library = name;
  out.line = line;
  out.make = make;
  return out;
}

LawEntry of_arm(const std::string& name, const std::string& line, LawEntry::Size size,
                LawEntry::Domain domain, LawMaker make) {
  LawEntry out = of_joints(name, line, make);
  out.size = size;
  out.on = LawEntry::On::kArm;
  out.domain = domain;
  return out;
}

LawEntry with_keys(LawEntry entry, std::vector<std::string> keys) {
  entry.keys = std::move(keys);
  return entry;
}

LawEntry needing(LawEntry entry, LawEntry::Needs needs) {
  entry.needs = needs;
  return entry;
}

LawEntry like(LawEntry entry, std::vector<std::string> others) {
  entry.same_as = std::move(others);
  return entry;
}

LawEntry called(LawEntry entry, const std::string& library) {
  entry.library = library;
  return entry;
}

LawEntry during(LawEntry entry, LawEntry::Domain domain) {
  entry.domain = domain;
  return entry;
}

}  // namespace plumb::offline::sim
