// SPDX-License-Identifier: Apache-2.0
#include "rt/verb_seal.hpp"

#include <fmt/format.h>

#include <memory>
#include <optional>

#include "program/file.hpp"
#include "program/key_file.hpp"
#include "program/shell_word.hpp"
#include "program/sums_signature.hpp"
#include "rt/check_sums.hpp"
#include "rt/deployment.hpp"
#include "rt/place.hpp"

namespace plumb::drivers::rt {
namespace {

struct SealOptions {
  std::string dir;
  std::string key;  // file of the private key; empty: the folder is not signed
  bool all = false;
};

/// What is installed is never edited; it would not be what was signed and verified any more.
void refuse_versions(const std::filesystem::path& folder) {
  const auto whole = std::filesystem::absolute(folder / "").lexically_normal().parent_path();
  const bool version =
      whole.parent_path().filename() == "versions" && is_place(whole.parent_path().parent_path());
  if (!version && !is_place(folder)) return;
  throw Failure(Exit::kInput,
                {.code = "E-RT-PLACE",
                 .message = fmt::format("{} is installed, and what is installed is not edited",
                                        display_name(folder)),
                 .help = "edit and seal a deploy folder elsewhere, then: plumb-rt install DIR"});
}

/// A seal alone would leave a signature that does not hold any more.
void refuse_breaking_signature(const SealOptions& options) {
  std::error_code ignored;
  const auto file = std::filesystem::path(options.dir) / kSignatureFile;
  if (!options.key.empty() || !std::filesystem::exists(file, ignored)) return;
  throw Failure(Exit::kInput,
                {.code = "E-RT-SIGNATURE",
                 .message = fmt::format("{} is signed, and a seal alone would break its signature",
                                        display_name(options.dir)),
                 .help = fmt::format("plumb-rt seal {} --sign FILE.key",
                                     shell_word(display_name(options.dir)))});
}

Json changed_files(const std::vector<SummedFile>& before) {
  Json out = Json::array();
  for (const SummedFile& file : before)
    if (file.state != SummedFile::State::kAsListed) out.push_back(file.name);
  return out;
}

std::string named(const Json& names) {
  std::string out;
  for (const auto& name : names) out += (out.empty() ? "" : ", ") + name.get<std::string>();
  return out.empty() ? "nothing" : out;
}

/// Sums only what plumb-rt would run: the whole folder is read and checked first.
void seal(const SealOptions& options, Outcome& outcome) {
  refuse_versions(options.dir);
  refuse_breaking_signature(options);
  std::optional<SecretKey> key;
  if (!options.key.empty()) key.emplace(read_secret_key(options.key));
  const Deployment deployment = load_deployment(options.dir, Sums::kIgnored);
  const auto before = renew_sums(options.dir, deployment.config.model,
                                 options.all ? Renew::kAll : Renew::kConfiguration);
  if (key)
    write_file_atomically(std::filesystem::path(options.dir) / kSignatureFile,
                          sign_sums(*key, sums_text(options.dir)));
  const Json changed = changed_files(before);
  outcome.inputs.push_back({deployment.config.model.string(), deployment.model.sha256});
  outcome.result = {
      {"folder", options.dir}, {"changed", changed}, {"key_id", key ? key->public_key().id() : ""}};
  outcome.text = fmt::format(
      "SHA256SUMS is renewed{}; changed since the last time: {}.\n"
      "mode {}, largest correction {:.4g} mm\n\nNext:\n  plumb-rt run {} --check\n",
      key ? fmt::format(" and signed by key {}", key->public_key().id()) : "", named(changed),
      to_string(deployment.session.mode), 1e3 * deployment.model.loaded->limits().max_correction_m,
      shell_word(options.dir));
}

}  // namespace

void add_seal(Program& program) {
  const auto options = std::make_shared<SealOptions>();
  VerbOptions verb =
      program.verb({.name = "seal",
                    .summary = "Accept an edited rt.toml: check the folder and renew SHA256SUMS",
                    .examples = "  plumb-rt seal deploy         # after rt.toml was edited\n"
                                "  plumb-rt seal deploy --all   # the model was replaced, too"},
                   [options](const Globals&, Outcome& outcome) { seal(*options, outcome); });
  verb.add_option("DIR", options->dir, "The folder that 'plumb deploy' wrote").required();
  verb.add_flag("--all", options->all,
                "Renew the sums of all files, not of rt.toml alone, and make a list that is lost");
  verb.add_option("--sign", options->key, "Sign the folder with the private key in FILE.key")
      .type_name("FILE");
}

}  // namespace plumb::drivers::rt
