// SPDX-License-Identifier: Apache-2.0
#include "rt/folder_origin.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>
#include <set>
#include <stdexcept>

#include "program/bounded_file.hpp"
#include "program/file.hpp"
#include "program/shell_word.hpp"
#include "program/sums_signature.hpp"
#include "rt/check_sums.hpp"
#include "rt/listed_files.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMostSignatureBytes = 4096;

/// Refuses a folder for its signature, together with what is wrong with the keys, which may be why.
[[noreturn]] void refuse_origin(const char* code, std::string message, std::string help,
                                const SigningRules& rules) {
  std::vector<Problem> problems{
      {.code = code, .message = std::move(message), .help = std::move(help)}};
  problems.insert(problems.end(), rules.keys.problems.begin(), rules.keys.problems.end());
  throw Failure(Exit::kInput, std::move(problems));
}

bool is_there(const fs::path& file) {
  struct stat found {};
  return ::lstat(file.c_str(), &found) == 0 || errno != ENOENT;
}

SumsSignature read_signature_file(const fs::path& file, const SigningRules& rules) {
  const std::string text = read_regular_file(file, kMostSignatureBytes);
  try {
    return read_signature(text);
  } catch (const std::invalid_argument& why) {
    refuse_origin("E-RT-SIGNATURE",
                  fmt::format("{} is no signature: {}", display_name(file), why.what()),
                  "deploy again: plumb deploy --sign FILE.key", rules);
  }
}

[[noreturn]] void refuse_content(const fs::path& file, const std::string& why) {
  throw Failure(Exit::kInput, {.code = "E-RT-FOLDER",
                               .message = fmt::format("{} {}", display_name(file), why),
                               .help = "ls -la " + shell_word(display_name(file.parent_path()))});
}

/// Files of this folder that plumb-rt writes while it runs it.
bool is_run_file(const std::string& name) {
  return name == "events.jsonl" || name == "events.jsonl.1" || name == "plumb-rt.sock" ||
         name == "plumb-rt.state" ||
         (name.starts_with("plumb-rt.state.") && name.ends_with(".tmp")) ||
         name.starts_with("snapshots/");
}

/// True for one of these files, and for what plumb-rt appends a number to: "record.log.3".
bool is_written(const fs::path& folder, const std::string& name,
                const std::vector<fs::path>& written) {
  return std::any_of(written.begin(), written.end(), [&](const fs::path& file) {
    if (file.empty()) return false;
    const std::string own = listed_name(folder, file);
    if (!name.starts_with(own)) return false;
    const std::string rest = name.substr(own.size());
    return rest.empty() || (rest.size() > 1 && rest[0] == '.' &&
                            rest.find_first_not_of("0123456789", 1) == std::string::npos);
  });
}

/// Why this kind of file may not stand in a folder; empty: it may.
std::string kind_fault(const struct stat& found, const std::string& name) {
  if (S_ISLNK(found.st_mode)) return "is a symbolic link, which may point elsewhere tomorrow";
  if (S_ISDIR(found.st_mode)) return "";
  if (S_ISSOCK(found.st_mode) && name == "plumb-rt.sock") return "";
  if (!S_ISREG(found.st_mode)) return "is no regular file";
  if (found.st_nlink != 1) return "has several names (hard links), by which others may change it";
  return "";
}

}  // namespace

Origin find_origin(const fs::path& folder, const std::string& sums, const SigningRules& rules) {
  Origin out;
  const std::string name = display_name(folder);
  const bool allowed = rules.unsigned_folders != SigningRules::Unsigned::kRefused;
  if (!is_there(folder / kSignatureFile)) {
    if (!allowed)
      refuse_origin(
          "E-RT-UNSIGNED",
          fmt::format("{} is not signed, and this machine runs only what a key of {} signed", name,
                      (rules.etc / "keys.d").string()),
          "plumb deploy --sign FILE.key; or unsigned = \"allowed\" in " +
              (rules.etc / "plumb-rt.toml").string(),
          rules);
    out.note = rules.unsigned_note();
    return out;
  }
  const SumsSignature signature = read_signature_file(folder / kSignatureFile, rules);
  out.key_id = signature.key_id;
  if (!rules.demanded()) {
    out.note = fmt::format(
        "its signature by key {} is not checked: no keys are set up on this "
        "machine",
        signature.key_id);
    return out;
  }
  const KnownKey* const key = rules.keys.find(signature.key_id);
  if (key == nullptr)
    refuse_origin("E-RT-SIGNER",
                  fmt::format("{} is signed by key {}, which is none of {}", name, signature.key_id,
                              (rules.etc / "keys.d").string()),
                  "if you trust it, copy its .pub to " + (rules.etc / "keys.d").string(), rules);
  if (key->trust == KnownKey::Trust::kRevoked)
    refuse_origin("E-RT-REVOKED",
                  fmt::format("{} is signed by key {}, which is revoked", name, key->name),
                  "deploy again with a key that is trusted: plumb deploy --sign FILE.key", rules);
  if (!signs(signature, key->key, sums))
    refuse_origin("E-RT-SIGNATURE",
                  fmt::format("the signature of {} by key {} does not hold: SHA256SUMS is not the "
                              "one that was signed",
                              name, key->name),
                  "deploy again: plumb deploy --sign FILE.key", rules);
  out.key = key->name;
  return out;
}

void check_content(const fs::path& folder, const std::string& sums, Beside beside,
                   const std::vector<fs::path>& written) {
  const std::vector<std::string> names = listed_files(folder, sums);
  const std::set<std::string> listed(names.begin(), names.end());
  std::set<std::string> folders{"snapshots"};
  for (const std::string& name : names)
    for (fs::path up = fs::path(name).parent_path(); !up.empty(); up = up.parent_path())
      folders.insert(up.string());
  std::error_code error;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end;
       at.increment(error)) {
    const std::string name = at->path().lexically_relative(folder).string();
    struct stat found {};
    if (::lstat(at->path().c_str(), &found) != 0) {
      if (errno == ENOENT) continue;  // a run file that has gone meanwhile
      refuse_content(at->path(), std::string("cannot be looked at: ") + std::strerror(errno));
    }
    if (const std::string fault = kind_fault(found, name); !fault.empty())
      refuse_content(at->path(), fault);
    const bool own = name == kSumsFile || name == kSignatureFile;
    const bool known = S_ISDIR(found.st_mode)
                           ? folders.contains(name)
                           : own || listed.contains(name) ||
                                 (beside == Beside::kRunFiles &&
                                  (is_run_file(name) || is_written(folder, name, written)));
    if (!known) refuse_content(at->path(), "stands in the folder, and SHA256SUMS does not list it");
  }
  if (error) refuse_content(folder, "cannot be read: " + error.message());
}

}  // namespace plumb::drivers::rt
