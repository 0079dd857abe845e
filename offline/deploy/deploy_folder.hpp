// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace plumb::offline {

struct DeployFile {
  std::string name;
  std::string bytes;
  enum class Summed { kYes, kNo } summed = Summed::kYes;  // kNo: made to be edited
};

/// "hash  name" a line, as sha256sum -c reads it.
std::string check_sums(const std::vector<DeployFile>& files);

/// Writes the files and SHA256SUMS. A folder that is not there appears whole or not at all. Into
/// one that is there each file goes whole, without SHA256SUMS from the first to the last; other
/// files in it stay. Throws what the file system says.
void write_deploy_folder(const std::filesystem::path& folder, const std::vector<DeployFile>& files);

}  // namespace plumb::offline
