// SPDX-License-Identifier: Apache-2.0
#include "rt/folder_origin.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <functional>

#include "program/sums_signature.hpp"
#include "rt/listener.hpp"
#include "tests/drivers/deployed.hpp"
#include "tests/drivers/rt/problem_of.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;

class FolderContent : public testing::Test {
 protected:
  Problem problem(Beside beside, const std::vector<fs::path>& written = {}) const {
    return tests::problem_of(
        [&] { check_content(folder.folder, folder.text("SHA256SUMS"), beside, written); });
  }
  void make(const std::string& name) const {
    fs::create_directories((folder.folder / name).parent_path());
    std::ofstream(folder.folder / name) << "x\n";
  }
  const tests::Deployed folder;
};

TEST_F(FolderContent, WhatIsListedAndTheSignatureMayStandThere) {
  EXPECT_EQ(problem(Beside::kNothing).code, "");
  make("SHA256SUMS.sig");
  EXPECT_EQ(problem(Beside::kNothing).code, "");
}

TEST_F(FolderContent, OneFileMoreIsFoundByNameWhereverItStands) {
  for (const char* const name :
       {"extra", "rt.toml.bak", ".hidden", "below/deep/extra", "SHA256SUMS.old", "events.jsonl.2",
        "robot.plumb.1", "below/events.jsonl"}) {
    make(name);
    for (const Beside beside : {Beside::kNothing, Beside::kRunFiles}) {
      const Problem found = problem(beside);
      EXPECT_EQ(found.code, "E-RT-FOLDER") << name;
      const std::string first = fs::path(name).begin()->string();
      EXPECT_NE(found.message.find(first), std::string::npos) << found.message;
    }
    fs::remove_all(folder.folder / *fs::path(name).begin());
    ASSERT_EQ(problem(Beside::kNothing).code, "");
  }
}

TEST_F(FolderContent, WhatARunWritesMayStandInAFolderThatRunsAndNotInAVersion) {
  for (const char* const name : {"events.jsonl", "events.jsonl.1", "plumb-rt.state",
                                 "plumb-rt.state.12.tmp", "snapshots/2026.log"}) {
    make(name);
    EXPECT_EQ(problem(Beside::kRunFiles).code, "") << name;
    EXPECT_EQ(problem(Beside::kNothing).code, "E-RT-FOLDER") << name;
    fs::remove(folder.folder / name);
  }
}

TEST_F(FolderContent, WhatTheSettingsLetItWriteMayStandThereWithANumberOnly) {
  const std::vector<fs::path> written{folder.folder / "record.log", {}, "/elsewhere/extra"};
  for (const char* const name : {"record.log", "record.log.1", "record.log.27"}) {
    make(name);
    EXPECT_EQ(problem(Beside::kRunFiles, written).code, "") << name;
    EXPECT_EQ(problem(Beside::kNothing, written).code, "E-RT-FOLDER") << name;
    EXPECT_EQ(problem(Beside::kRunFiles).code, "E-RT-FOLDER") << name;
    fs::remove(folder.folder / name);
  }
  for (const char* const name :
       {"record.log.", "record.log.1x", "record.log1", "record.log.so", "record.lo", "extra"}) {
    make(name);
    EXPECT_EQ(problem(Beside::kRunFiles, written).code, "E-RT-FOLDER") << name;
    fs::remove(folder.folder / name);
  }
}

/// Each of these lets somebody change what is loaded after it was verified.
TEST_F(FolderContent, WhatIsNoFileOfItsOwnIsRefusedEvenUnderAListedName) {
  const fs::path file = folder.folder / "targets.csv", other = folder.folder.string() + "-other";
  std::ofstream(other) << folder.text("targets.csv");
  const std::function<void()> plants[] = {
      [&] { fs::create_symlink(other, file); },
      [&] { fs::create_hard_link(other, file); },
      [&] { ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0); },
      [&] { ASSERT_TRUE(listen_unix(file).has_value()); },
      [&] { fs::create_directory(file); },
      [&] { fs::create_directory_symlink(folder.folder, file); }};
  for (const auto& plant : plants) {
    fs::remove_all(file);
    plant();
    for (const Beside beside : {Beside::kNothing, Beside::kRunFiles}) {
      const Problem found = problem(beside);
      EXPECT_EQ(found.code, "E-RT-FOLDER");
      EXPECT_NE(found.message.find("targets.csv"), std::string::npos) << found.message;
    }
  }
  fs::remove(other);
}

TEST_F(FolderContent, ARunFileThatIsALinkIsRefused) {
  for (const char* const name : {"events.jsonl", "plumb-rt.state", "plumb-rt.sock", "snapshots"}) {
    fs::create_symlink("/tmp", folder.folder / name);
    EXPECT_EQ(problem(Beside::kRunFiles).code, "E-RT-FOLDER") << name;
    fs::remove(folder.folder / name);
  }
}

TEST_F(FolderContent, AListThatLeadsOutOfTheFolderIsRefused) {
  const std::string sum(64, 'a');
  for (const std::string name : {"../rt.toml", "/etc/passwd", "below/../../x", "./rt.toml",
                                 "SHA256SUMS", "SHA256SUMS.sig", ".."}) {
    const Problem found = tests::problem_of([&] {
      check_content(folder.folder, folder.text("SHA256SUMS") + sum + "  " + name + "\n",
                    Beside::kRunFiles, {});
    });
    EXPECT_EQ(found.code, "E-RT-FOLDER") << name;
  }
}

/// Rules of a machine in memory: with one trusted key, and one that is revoked.
class FolderOrigin : public testing::Test {
 protected:
  static KnownKey known(const char* name, const SecretKey& key, KnownKey::Trust trust) {
    KnownKey out;
    out.name = name;
    out.key = key.public_key();
    out.trust = trust;
    return out;
  }
  static SecretKey key_of(char seed) {
    const std::string bytes(32, seed);
    return SecretKey::read("plumb-ed25519-secret " +
                           base64(reinterpret_cast<const unsigned char*>(bytes.data()), 32));
  }
  SigningRules rules(SigningRules::Unsigned unsigned_folders) const {
    SigningRules out;
    out.etc = "/etc/plumb";
    out.unsigned_folders = unsigned_folders;
    if (unsigned_folders != SigningRules::Unsigned::kNoKeys)
      out.keys.keys = {known("anna", anna, KnownKey::Trust::kTrusted),
                       known("old", old, KnownKey::Trust::kRevoked)};
    return out;
  }
  void sign(const SecretKey& key) const {
    std::ofstream(folder.folder / "SHA256SUMS.sig") << sign_sums(key, folder.text("SHA256SUMS"));
  }
  std::string code(SigningRules::Unsigned unsigned_folders) const {
    return tests::problem_of([&] {
             std::ignore =
                 find_origin(folder.folder, folder.text("SHA256SUMS"), rules(unsigned_folders));
           })
        .code;
  }
  const SecretKey anna = key_of('a'), old = key_of('o'), stranger = key_of('s');
  const tests::Deployed folder;
};

using Unsigned = SigningRules::Unsigned;

TEST_F(FolderOrigin, OnlyATrustedKeyGivesAFolderItsNameAndWhatWaivesItSaysSo) {
  sign(anna);
  for (const Unsigned rule : {Unsigned::kRefused, Unsigned::kAllowed, Unsigned::kNoKeys}) {
    const Origin origin = find_origin(folder.folder, folder.text("SHA256SUMS"), rules(rule));
    EXPECT_EQ(origin.key_id, anna.public_key().id());
    EXPECT_EQ(origin.key, rule == Unsigned::kNoKeys ? "" : "anna");
    EXPECT_EQ(origin.note.empty(), !origin.key.empty()) << "one of the two";
  }
}

TEST_F(FolderOrigin, AnUnsignedFolderIsRefusedOrNoted) {
  EXPECT_EQ(code(Unsigned::kRefused), "E-RT-UNSIGNED");
  for (const Unsigned rule : {Unsigned::kAllowed, Unsigned::kNoKeys}) {
    const Origin origin = find_origin(folder.folder, "", rules(rule));
    EXPECT_EQ(origin.key + origin.key_id, "");
    EXPECT_NE(origin.note, "");
  }
}

/// What waives a signature waives none that is bad: somebody has meant to sign.
TEST_F(FolderOrigin, ABadSignatureIsRefusedAlsoWhereNoneIsNeeded) {
  for (const Unsigned rule : {Unsigned::kRefused, Unsigned::kAllowed}) {
    sign(stranger);
    EXPECT_EQ(code(rule), "E-RT-SIGNER");
    sign(old);
    EXPECT_EQ(code(rule), "E-RT-REVOKED");
    sign(anna);
    EXPECT_EQ(tests::problem_of([&] {
                std::ignore =
                    find_origin(folder.folder, folder.text("SHA256SUMS") + "\n", rules(rule));
              }).code,
              "E-RT-SIGNATURE");
    for (const std::string text : {"", "x", "plumb-ed25519 0123456789abcdef AAAA\n"}) {
      std::ofstream(folder.folder / "SHA256SUMS.sig") << text;
      EXPECT_EQ(code(rule), "E-RT-SIGNATURE") << text;
    }
  }
}

TEST_F(FolderOrigin, ASignatureThatLeadsNowhereIsNotAFolderWithoutOne) {
  fs::create_symlink("nowhere", folder.folder / "SHA256SUMS.sig");
  for (const Unsigned rule : {Unsigned::kRefused, Unsigned::kAllowed, Unsigned::kNoKeys})
    EXPECT_EQ(code(rule).substr(0, 6), "E-READ");
}

}  // namespace
}  // namespace plumb::drivers::rt
