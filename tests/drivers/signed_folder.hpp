// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "program/key_file.hpp"
#include "program/sums_signature.hpp"
#include "tests/drivers/deployed.hpp"
#include "tests/drivers/rt_program.hpp"

namespace plumb::tests {

/// The settings of a machine that demands signatures, in a folder of its own: keys.d with the keys
/// that a test trusts. The private keys stand beside it.
class Machine {
 public:
  Machine() {
    std::string name = (std::filesystem::temp_directory_path() / "plumb-etc-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    root = name;
    std::filesystem::create_directories(keys());
    for (const auto& folder : {etc(), keys()}) ::chmod(folder.c_str(), 0755);
  }
  ~Machine() {
    std::error_code ignored;
    std::filesystem::remove_all(root, ignored);
  }
  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;

  std::filesystem::path etc() const { return root / "etc"; }
  std::filesystem::path keys() const { return etc() / "keys.d"; }

  /// A new pair of keys; its private part is kept under this name.
  SecretKey make_key(const std::string& name) const {
    const KeyFiles made = write_new_keys(root / name);
    return read_secret_key(made.secret);
  }
  /// A new pair whose public part is trusted here.
  SecretKey trusted_key(const std::string& name) const {
    SecretKey out = make_key(name);
    std::filesystem::copy_file(root / (name + ".pub"), keys() / (name + ".pub"));
    ::chmod((keys() / (name + ".pub")).c_str(), 0644);
    return out;
  }
  void write(const std::string& file, const std::string& text) const {
    std::ofstream(etc() / file) << text;
    ::chmod((etc() / file).c_str(), 0644);
  }

  /// plumb-rt with these words, by the settings of this machine.
  RtRan rt(std::vector<std::string> words) const {
    words.insert(words.end(), {"--etc", etc().string()});
    return plumb_rt(std::move(words), root);
  }

  std::filesystem::path root;
};

inline std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Signs a folder as plumb deploy does.
inline void sign(const std::filesystem::path& folder, const SecretKey& key) {
  std::ofstream(folder / kSignatureFile) << sign_sums(key, text_of(folder / kSumsFile));
}

/// rt.toml with a time at which it was made.
inline std::string made_text(const std::string& made, const std::string& more = "") {
  return Deployed::csv(more) + "[model]\nmade = \"" + made + "\"\n";
}

/// Writes it, and the sums.
inline void write_made(const Deployed& folder, const std::string& made,
                       const std::string& more = "") {
  folder.write("rt.toml", made_text(made, more));
}

/// The same with a cycle four times as long, so that the targets last four times longer.
inline void write_made_slow(const Deployed& folder, const std::string& made) {
  std::string text = made_text(made);
  const std::string usual = "cycle_us = 1000";
  text.replace(text.find(usual), usual.size(), "cycle_us = 4000");
  folder.write("rt.toml", text);
}

/// Targets that go on for longer than a test.
inline void write_endless_targets(const Deployed& folder, int rows = 30'000) {
  const std::string first = folder.text("targets.csv");
  const std::size_t header = first.find('\n') + 1;
  const std::string row = first.substr(header, first.find('\n', header) + 1 - header);
  std::string all = first.substr(0, header);
  for (int i = 0; i < rows; ++i) all += row;
  folder.write("targets.csv", all);
}

/// A model that corrects a little differently.
inline format::Model other_arm(double shift_m) {
  format::Model out = Deployed::arm();
  for (auto& joint : out.calibrated.joints) joint.a -= shift_m;
  return out;
}

}  // namespace plumb::tests
