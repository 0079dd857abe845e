// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "programs/languages.hpp"

namespace plumb::offline::programs {

inline std::string corpus(const std::string& name) {
  std::ifstream in(std::string(PLUMB_CORPUS) + "/" + name, std::ios::binary);
  EXPECT_TRUE(in.good()) << name;
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

/// The first move that goes to a target.
inline Move first_move(const Program& program) {
  for (const Move& move : program.moves)
    if (move.target >= 0) return move;
  ADD_FAILURE() << "no move goes to a target";
  return {};
}

/// A program of these bytes, as the verb would read it.
inline Program read_bytes(const std::string& file, const std::string& bytes,
                          const std::string& data = "") {
  std::vector<Source> sources{{file, bytes}};
  if (!data.empty()) sources.push_back({"x.dat", data});
  return read_programs(*language_of(file), {std::move(sources)}).at(0);
}

inline Program read_corpus(const std::string& file, const std::string& data = "") {
  return read_bytes(file, corpus(file), data.empty() ? "" : corpus(data));
}

/// Names of the targets that may be corrected, so far as the reader can tell.
inline std::set<std::string> free_targets(const Program& program) {
  std::set<std::string> out;
  for (const Target& target : program.targets)
    if (target.why.empty() && !of_joints(target.written.notation)) out.insert(target.name);
  return out;
}

inline const Target& named(const Program& program, const std::string& name) {
  for (const Target& target : program.targets)
    if (target.name == name) return target;
  ADD_FAILURE() << name;
  return program.targets.front();
}

}  // namespace plumb::offline::programs
