// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace plumb::drivers::rt {

/// A line of SHA256SUMS: a file, named relative to the folder, and whether it is as listed.
struct SummedFile {
  std::string name;
  std::string sha256;  // as listed
  enum class State { kAsListed, kOther, kMissing } state = State::kAsListed;
};

/// Reads SHA256SUMS and compares every file that it lists. Throws Failure (kInput, E-RT-SUMS) if it
/// is missing, empty or has a line that is none of sha256sum. Slow.
std::vector<SummedFile> read_sums(const std::filesystem::path& folder);

/// Throws Failure (kInput, E-RT-SUMS) unless SHA256SUMS lists rt.toml and `model`, and every file
/// that it lists is as listed. Other files of the folder are not checked. Slow.
void verify_sums(const std::filesystem::path& folder, const std::filesystem::path& model);

/// Writes SHA256SUMS anew with the present sum of rt.toml, all or nothing. Throws Failure (kInput,
/// E-RT-SUMS), and writes nothing, if another file is not as listed. With kAll the present sums of
/// rt.toml, `model` and all files that were listed and still exist. Returns what was listed before
/// (nothing if it could not be read).
enum class Renew { kConfiguration, kAll };
std::vector<SummedFile> renew_sums(const std::filesystem::path& folder,
                                   const std::filesystem::path& model, Renew renew);

}  // namespace plumb::drivers::rt
