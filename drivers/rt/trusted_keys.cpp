// SPDX-License-Identifier: Apache-2.0
#include "rt/trusted_keys.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "program/file.hpp"
#include "program/key_file.hpp"
#include "program/shell_word.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;

Problem key_problem(std::string message, const fs::path& file) {
  return {.code = "E-RT-KEYS",
          .message = std::move(message),
          .help = "ls -ld " + shell_word(display_name(file))};
}

/// Adds the key of one file, or what is wrong with it.
void add_key(const fs::path& file, KnownKey::Trust trust, TrustedKeys& out) {
  try {
    const OwnedText read = read_owned_text(file);
    if (auto bad = rights_problem(file, rights_fault(read.owner, read.mode)); !bad.empty()) {
      out.problems.push_back(std::move(bad.front()));
      return;
    }
    out.keys.push_back(
        {.name = file.stem().string(), .key = read_public_key(read.text), .trust = trust});
  } catch (const Failure& failure) {
    out.problems.push_back(key_problem(failure.problems().front().message, file));
  } catch (const std::invalid_argument& why) {
    out.problems.push_back(
        key_problem(fmt::format("{} is no public key: {}", display_name(file), why.what()), file));
  }
}

}  // namespace

std::vector<Problem> rights_problem(const fs::path& file, const std::string& fault) {
  if (fault.empty()) return {};
  return {
      {.code = "E-RT-KEYS",
       .message = fmt::format("{} is not used: it {}", display_name(file), fault),
       .help = fmt::format("if its content is right: sudo chown root {0} && sudo chmod go-w {0}",
                           shell_word(display_name(file)))}};
}

const KnownKey* TrustedKeys::find(const std::string& id) const {
  const KnownKey* found = nullptr;
  for (const KnownKey& one : keys)
    if (one.key.id() == id && (found == nullptr || one.trust == KnownKey::Trust::kRevoked))
      found = &one;
  return found;
}

TrustedKeys read_trusted_keys(const fs::path& folder) {
  TrustedKeys out;
  struct stat found {};
  if (::lstat(folder.c_str(), &found) != 0) {
    out.problems = {key_problem(
        fmt::format("{} cannot be read: {}", display_name(folder), std::strerror(errno)), folder)};
    return out;
  }
  out.problems = rights_problem(
      folder, S_ISDIR(found.st_mode) ? rights_fault(found.st_uid, found.st_mode) : "is no folder");
  if (!out.problems.empty()) return out;
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    files.push_back(at->path());
  if (error)
    out.problems.push_back(key_problem(
        fmt::format("{} cannot be read: {}", display_name(folder), error.message()), folder));
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    if (file.extension() == ".pub") add_key(file, KnownKey::Trust::kTrusted, out);
    if (file.extension() == ".revoked") add_key(file, KnownKey::Trust::kRevoked, out);
  }
  return out;
}

}  // namespace plumb::drivers::rt
