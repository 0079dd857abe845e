// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::offline::scrambled {

/// The two files of a cell as text, and what was done to them. The scrambling works on the text
/// with code of its own, so it shares nothing with what is tested.
struct Files {
  std::string cell;  // cell.toml
  std::string csv;   // measurements.csv
  std::vector<std::string> done;
};

/// A random arm of 4 to 7 joints in either convention, or a SCARA, with errors of 0.5 mm and 0.5
/// mrad, seen in 30 to 150 poses with 10 to 50 um of noise.
Files random_files(tests::Random& random);

/// A random 6-joint arm in either convention, with the same errors, in 80 poses with 20 um of
/// noise.
Files six_joints(std::uint64_t seed);

/// `files` with one to three mistakes: convention, units, joint directions, left-handed
/// coordinates.
Files scramble(const Files& files, tests::Random& random);

/// Writes the files into `folder` and reads them as a verb would.
struct Case {
  Cell cell;
  MeasurementFiles measured;
};
Case opened(const Files& files, const std::filesystem::path& folder);

/// A folder of its own, removed at the end.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace plumb::offline::scrambled
