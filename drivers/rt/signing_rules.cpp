// SPDX-License-Identifier: Apache-2.0
#include "rt/signing_rules.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>

#include "program/file.hpp"
#include "program/key_file.hpp"
#include "program/toml_table.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;

constexpr char kKeysFolder[] = "keys.d", kMachineFile[] = "plumb-rt.toml";

/// True unless it is certain that nothing of this name is there.
bool may_exist(const fs::path& file) {
  struct stat found {};
  return ::lstat(file.c_str(), &found) == 0 || (errno != ENOENT && errno != ENOTDIR);
}

/// Whoever may write to the folder itself could take keys.d away, and with it every demand.
std::vector<Problem> etc_problem(const fs::path& etc) {
  struct stat found {};
  if (::stat(etc.c_str(), &found) != 0) {
    if (errno == ENOENT || errno == ENOTDIR) return {};
    return rights_problem(etc, std::string("cannot be looked at: ") + std::strerror(errno));
  }
  return rights_problem(etc, rights_fault(found.st_uid, found.st_mode));
}

bool unsigned_allowed(const fs::path& file) {
  if (!may_exist(file)) return false;
  const OwnedText read = read_owned_text(file);
  if (auto bad = rights_problem(file, rights_fault(read.owner, read.mode)); !bad.empty())
    throw Failure(Exit::kInput, std::move(bad));
  TomlSource source(display_name(file), read.text, "E-RT");
  const toml::table parsed = source.parse();
  TomlTable top(parsed, "", source);
  const bool allowed = top.choice("unsigned", {"refused", "allowed"}) == "allowed";
  top.done();
  source.stop_on_errors();
  return allowed;
}

}  // namespace

std::string SigningRules::unsigned_note() const {
  switch (unsigned_folders) {
    case Unsigned::kNoKeys:
      return "unsigned: no keys are set up on this machine";
    case Unsigned::kAllowed:
      return fmt::format("unsigned: {} allows it", (etc / kMachineFile).string());
    case Unsigned::kRefused:
      break;
  }
  return "";
}

void add_etc_option(VerbOptions& verb, std::string& etc) {
  verb.add_option("--etc", etc, "The folder of this machine's settings, with keys.d")
      .type_name("DIR")
      .shows_default();
}

SigningRules read_signing_rules(const fs::path& etc) {
  SigningRules out;
  out.etc = etc;
  if (auto bad = etc_problem(etc); !bad.empty()) {
    out.keys.problems = std::move(bad);
    return out;
  }
  if (!may_exist(etc / kKeysFolder)) {
    out.unsigned_folders = SigningRules::Unsigned::kNoKeys;
    return out;
  }
  out.keys = read_trusted_keys(etc / kKeysFolder);
  if (unsigned_allowed(etc / kMachineFile)) out.unsigned_folders = SigningRules::Unsigned::kAllowed;
  return out;
}

std::vector<Problem> key_warnings(const SigningRules& rules) {
  std::vector<Problem> out = rules.keys.problems;
  for (Problem& one : out) {
    one.severity = Severity::kWarning;
    one.code = "W-RT-KEYS";
  }
  return out;
}

}  // namespace plumb::drivers::rt
