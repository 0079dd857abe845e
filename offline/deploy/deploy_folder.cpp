// SPDX-License-Identifier: Apache-2.0
#include "deploy/deploy_folder.hpp"

#include <fmt/format.h>

#include "program/file.hpp"
#include "program/interrupt.hpp"
#include "program/process_number.hpp"
#include "program/sums_signature.hpp"

namespace plumb::offline {
namespace {

namespace fs = std::filesystem;

void write_into(const fs::path& folder, const std::vector<DeployFile>& files,
                const SecretKey* key) {
  const std::string sums = check_sums(files);
  for (const DeployFile& file : files) write_file_atomically(folder / file.name, file.bytes);
  write_file_atomically(folder / kSumsFile, sums);
  if (key != nullptr) write_file_atomically(folder / kSignatureFile, sign_sums(*key, sums));
}

void write_new_folder(const fs::path& folder, const std::vector<DeployFile>& files,
                      const SecretKey* key) {
  if (folder.has_parent_path()) fs::create_directories(folder.parent_path());
  const fs::path draft =
      folder.parent_path() /
      fmt::format(".{}.{}.tmp", folder.filename().string(), own_process_number());
  try {
    fs::create_directory(draft);
    write_into(draft, files, key);
    fs::rename(draft, folder);
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(draft, ignored);
    throw;
  }
}

}  // namespace

std::string check_sums(const std::vector<DeployFile>& files) {
  std::string out;
  for (const DeployFile& file : files)
    out += fmt::format("{}  {}\n", sha256(file.bytes), file.name);
  return out;
}

void write_deploy_folder(const fs::path& folder, const std::vector<DeployFile>& files,
                         const SecretKey* key) {
  const fs::path whole = fs::absolute(folder / "").lexically_normal().parent_path();
  const Writing writing;
  if (!fs::exists(whole)) return write_new_folder(whole, files, key);
  fs::remove(whole / kSignatureFile);
  fs::remove(whole / kSumsFile);
  write_into(whole, files, key);
}

}  // namespace plumb::offline
