// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "program/problem.hpp"

namespace plumb::offline {

/// A folder of its own that disappears with the test.
class Folder {
 public:
  Folder() {
    std::string pattern = std::filesystem::temp_directory_path() / "plumb_cell_XXXXXX";
    path_ = ::mkdtemp(pattern.data());
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path put(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

/// The problems a call throws; none if it does not.
inline std::vector<Problem> problems_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Failure& failure) {
    return failure.problems();
  }
  return {};
}

/// "E-CSV-UNIT 1:20", one word pair a problem.
inline std::vector<std::string> summary(const std::vector<Problem>& problems) {
  std::vector<std::string> out;
  for (const auto& p : problems) {
    const Place place = p.place.value_or(Place{});
    out.push_back(p.code + " " + std::to_string(place.line) + ":" + std::to_string(place.column));
  }
  return out;
}

using Summary = std::vector<std::string>;

}  // namespace plumb::offline
