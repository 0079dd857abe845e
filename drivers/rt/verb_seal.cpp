// SPDX-License-Identifier: Apache-2.0
#include "rt/verb_seal.hpp"

#include <fmt/format.h>

#include <memory>

#include "program/shell_word.hpp"
#include "rt/check_sums.hpp"
#include "rt/deployment.hpp"

namespace plumb::drivers::rt {
namespace {

struct SealOptions {
  std::string dir;
  bool all = false;
};

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
  const Deployment deployment = load_deployment(options.dir, Sums::kIgnored);
  const auto before = renew_sums(options.dir, deployment.config.model,
                                 options.all ? Renew::kAll : Renew::kConfiguration);
  const Json changed = changed_files(before);
  outcome.inputs.push_back({deployment.config.model.string(), deployment.model.sha256});
  outcome.result = {{"folder", options.dir}, {"changed", changed}};
  outcome.text = fmt::format(
      "SHA256SUMS is renewed; changed since the last time: {}.\n"
      "mode {}, largest correction {:.4g} mm\n\nNext:\n  plumb-rt run {} --check\n",
      named(changed), to_string(deployment.session.mode),
      1e3 * deployment.model.loaded->limits().max_correction_m, shell_word(options.dir));
}

}  // namespace

void add_seal(Program& program) {
  const auto options = std::make_shared<SealOptions>();
  VerbOptions verb = program.verb(
      {.name = "seal",
       .summary = "Accept an edited rt.toml: check the folder and renew SHA256SUMS",
       .examples = "  plumb-rt seal /etc/plumb/cell4         # after rt.toml was edited\n"
                   "  plumb-rt seal /etc/plumb/cell4 --all   # the model was replaced, too"},
      [options](const Globals&, Outcome& outcome) { seal(*options, outcome); });
  verb.add_option("DIR", options->dir, "The folder that 'plumb deploy' wrote").required();
  verb.add_flag("--all", options->all,
                "Renew the sums of all files, not of rt.toml alone, and make a list that is lost");
}

}  // namespace plumb::drivers::rt
