// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace plumb::drivers::rt {

/// A line of SHA256SUMS: a file, named relative to the folder, and whether it is as listed.
struct SummedFile {
  std::string name;
  std::string sha256;  // as listed
  enum class State { kAsListed, kOther, kMissing } state = State::kAsListed;
};

/// The text of SHA256SUMS. Throws Failure (kInput, E-RT-SUMS) if it is missing.
std::string sums_text(const std::filesystem::path& folder);

/// The lines of `text`, the content of SHA256SUMS; the files are not read. Throws Failure (kInput,
/// E-RT-SUMS) if it is empty or has a line that is none of sha256sum.
std::vector<SummedFile> sum_lines(const std::filesystem::path& folder, const std::string& text);

/// The sums that `text`, the content of SHA256SUMS, lists, by the names of their files, which are
/// not read. Throws as `sum_lines` does.
std::map<std::string, std::string> listed_sums(const std::filesystem::path& folder,
                                               const std::string& text);

/// Compares every file that `text`, the content of SHA256SUMS, lists. Throws as `sum_lines` does.
/// Slow.
std::vector<SummedFile> read_sums(const std::filesystem::path& folder, const std::string& text);

/// Throws Failure (kInput, E-RT-SUMS) unless `text`, the content of SHA256SUMS, lists each of these
/// files, and every file that it lists is as listed. Other files of the folder are not checked.
/// Slow.
void verify_sums(const std::filesystem::path& folder, const std::string& text,
                 const std::vector<std::filesystem::path>& files);

/// Throws Failure (kInput, E-RT-SUMS) unless `text` lists this file with this sum. `sha256`: of the
/// bytes that were read before; the file itself, which may have changed since, is not read again.
void refuse_other(const std::filesystem::path& folder, const std::string& text,
                  const std::filesystem::path& file, const std::string& sha256);

/// The name of a file in SHA256SUMS: relative to the folder.
std::string listed_name(const std::filesystem::path& folder, const std::filesystem::path& file);

/// Which sums are renewed: that of rt.toml, or those of rt.toml, the model and all files that were
/// listed and still exist.
enum class Renew { kConfiguration, kAll };

/// Writes SHA256SUMS anew, all or nothing. With kConfiguration throws Failure (kInput, E-RT-SUMS),
/// and writes nothing, if a file other than rt.toml is not as listed. Returns what was listed
/// before (nothing if it could not be read).
std::vector<SummedFile> renew_sums(const std::filesystem::path& folder,
                                   const std::filesystem::path& model, Renew renew);

}  // namespace plumb::drivers::rt
