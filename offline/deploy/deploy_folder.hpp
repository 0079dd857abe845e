// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "program/signing_key.hpp"

namespace plumb::offline {

struct DeployFile {
  std::string name;
  std::string bytes;
};

/// "hash  name" a line, as sha256sum -c reads it.
std::string check_sums(const std::vector<DeployFile>& files);

/// Writes the files and SHA256SUMS, and with a key its signature, SHA256SUMS.sig. A new folder
/// appears whole or not at all. In an existing folder each file is replaced whole; SHA256SUMS and
/// an old signature are removed first, the new ones are written last, and other files stay. Throws
/// the errors of the file system.
/// `key`: null leaves the folder unsigned.
void write_deploy_folder(const std::filesystem::path& folder, const std::vector<DeployFile>& files,
                         const SecretKey* key = nullptr);

}  // namespace plumb::offline
