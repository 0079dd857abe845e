// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "cli/verbs.hpp"
#include "program/key_file.hpp"
#include "program/shell_word.hpp"

namespace plumb::offline::cli {
namespace {

void make_keys(const std::string& name, Outcome& outcome) {
  const KeyFiles made = write_new_keys(name);
  outcome.result = {{"private_key", made.secret.string()},
                    {"public_key", made.shared.string()},
                    {"key_id", made.key.id()}};
  outcome.text = fmt::format(
      "Key {}.\n"
      "{} is private: keep it where you deploy, and a copy of it offline.\n"
      "{} is for the machines that shall trust it.\n\nNext, on each of these:\n"
      "  sudo install -D -m 644 {} /etc/plumb/keys.d/{}\nand here:\n"
      "  plumb deploy -o deploy --sign {}\n",
      made.key.id(), made.secret.string(), made.shared.string(), shell_word(made.shared.string()),
      shell_word(made.shared.filename().string()), shell_word(made.secret.string()));
}

}  // namespace

void add_keygen(Program& program) {
  const auto name = std::make_shared<std::string>();
  VerbOptions verb = program.verb(
      {.name = "keygen",
       .summary = "A new pair of keys, to sign deploy folders and to know them by",
       .examples = "  plumb keygen cell4                    # writes cell4.key and cell4.pub\n"
                   "  plumb deploy -o deploy --sign cell4.key",
       .in_cell = false},
      [name](const Globals&, Outcome& outcome) { make_keys(*name, outcome); });
  verb.add_option("NAME", *name, "Writes NAME.key, which is private, and NAME.pub").required();
}

}  // namespace plumb::offline::cli
