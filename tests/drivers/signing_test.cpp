// SPDX-License-Identifier: Apache-2.0
// Signatures of deploy folders: what a machine that demands them runs, and what it refuses.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <stdexcept>

#include "rt/status_text.hpp"
#include "tests/drivers/rights.hpp"
#include "tests/drivers/signed_folder.hpp"

namespace plumb::tests {
namespace {

namespace fs = std::filesystem;

/// A machine with one trusted key, and a folder that it signed.
class Signed : public testing::Test {
 protected:
  Signed() { sign(folder.folder, key); }

  RtRan check() const { return machine.rt({"run", folder.folder.string(), "--check"}); }

  /// The folder is refused with this code and these words, and with one message that says it.
  void refused(const char* code, const std::string& words) const {
    const RtRan ran = check();
    EXPECT_EQ(ran.exit, 3) << ran.err;
    EXPECT_NE(ran.err.find(std::string("error[") + code + "]"), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find(words), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find("= help: "), std::string::npos) << ran.err;
    EXPECT_EQ(ran.err.find("error["), ran.err.rfind("error[")) << "one message: " << ran.err;
  }

  const Machine machine;
  const SecretKey key = machine.trusted_key("anna");
  const Deployed folder;
};

TEST_F(Signed, AFolderThatATrustedKeySignedRuns) {
  const RtRan ran = check();
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_EQ(ran.err.find("unsigned"), std::string::npos) << ran.err;
  const RtRan played = machine.rt({"run", folder.folder.string(), "--json"});
  ASSERT_EQ(played.exit, 0) << played.err;
  auto origin = played.json()["result"]["install"];
  EXPECT_EQ(origin["signed_by"], "anna");
  EXPECT_EQ(origin["key_id"], key.public_key().id());
  EXPECT_EQ(origin["note"], "");
  EXPECT_NE(played.err.find("signed_by anna"), std::string::npos) << "the log says it";
  fs::remove(folder.folder / "corrected.csv");
  EXPECT_EQ(check().exit, 0) << "what a run leaves in the folder is no foreign file";
}

TEST_F(Signed, AnUnsignedFolderIsRefused) {
  fs::remove(folder.folder / kSignatureFile);
  refused("E-RT-UNSIGNED", "is not signed, and this machine runs only what a key of");
}

TEST_F(Signed, AFolderSignedByAnUnknownKeyIsRefused) {
  const SecretKey other = machine.make_key("mallory");
  sign(folder.folder, other);
  refused("E-RT-SIGNER", "is signed by key " + other.public_key().id() + ", which is none of");
}

TEST_F(Signed, AFolderSignedByARevokedKeyIsRefusedByName) {
  fs::rename(machine.keys() / "anna.pub", machine.keys() / "anna.revoked");
  refused("E-RT-REVOKED", "is signed by key anna, which is revoked");
}

TEST_F(Signed, AKeyThatIsTrustedAndRevokedIsRevoked) {
  fs::copy_file(machine.keys() / "anna.pub", machine.keys() / "zoe.revoked");
  refused("E-RT-REVOKED", "is signed by key zoe, which is revoked");
}

TEST_F(Signed, OneByteOfAnyFileIsFound) {
  for (const char* const name : {"rt.toml", "robot.plumb", "targets.csv"}) {
    SCOPED_TRACE(name);
    const std::string whole = text_of(folder.folder / name);
    std::string other = whole;
    other[other.size() - 2] = static_cast<char>(other[other.size() - 2] ^ 1);
    std::ofstream(folder.folder / name, std::ios::binary) << other;
    const RtRan ran = check();
    EXPECT_EQ(ran.exit, 3) << ran.err;
    std::ofstream(folder.folder / name, std::ios::binary) << whole;
    EXPECT_EQ(check().exit, 0);
  }
}

TEST_F(Signed, SumsThatWereRenewedAfterTheSignatureAreFound) {
  folder.write("targets.csv", folder.text("targets.csv") + "\n");
  refused("E-RT-SIGNATURE", "by key anna does not hold");
}

TEST_F(Signed, ASealOfASignedFolderNeedsAKey) {
  std::ofstream(folder.folder / "rt.toml") << Deployed::csv("target_step_mm = 20\n");
  const RtRan alone = plumb_rt({"seal", folder.folder.string()}, machine.root);
  EXPECT_EQ(alone.exit, 3);
  EXPECT_NE(alone.err.find("error[E-RT-SIGNATURE]"), std::string::npos) << alone.err;
  refused("E-RT-SUMS", "rt.toml is not the file that SHA256SUMS lists");
  const RtRan both =
      plumb_rt({"seal", folder.folder.string(), "--sign", (machine.root / "anna.key").string()},
               machine.root);
  EXPECT_EQ(both.exit, 0) << both.err;
  EXPECT_EQ(check().exit, 0);
}

TEST_F(Signed, AFileThatWasAddedIsFound) {
  std::ofstream(folder.folder / "extra.txt") << "x";
  refused("E-RT-FOLDER", "extra.txt stands in the folder, and SHA256SUMS does not list it");
  fs::remove(folder.folder / "extra.txt");
  fs::create_directory(folder.folder / "extra");
  refused("E-RT-FOLDER", "extra stands in the folder");
}

TEST_F(Signed, AFileThatIsMissingIsFound) {
  fs::remove(folder.folder / "targets.csv");
  refused("E-RT-SUMS", "targets.csv is missing, and SHA256SUMS lists it");
}

TEST_F(Signed, LinksAndPipesAreNoFiles) {
  const fs::path file = folder.folder / "targets.csv", aside = machine.root / "targets.csv";
  fs::copy_file(file, aside);
  fs::remove(file);
  fs::create_symlink(aside, file);
  refused("E-RT-FOLDER", "targets.csv is a symbolic link");
  fs::remove(file);
  fs::create_hard_link(aside, file);
  refused("E-RT-FOLDER", "targets.csv has several names (hard links)");
  fs::remove(file);
  fs::copy_file(aside, file);
  ASSERT_EQ(::mkfifo((folder.folder / "pipe").c_str(), 0600), 0);
  refused("E-RT-FOLDER", "pipe is no regular file");
  fs::remove(folder.folder / "pipe");
  EXPECT_EQ(check().exit, 0);
  fs::remove(folder.folder / kSignatureFile);
  ASSERT_EQ(::mkfifo((folder.folder / kSignatureFile).c_str(), 0600), 0);
  EXPECT_EQ(check().exit, 3) << "a pipe instead of the signature is not waited for";
}

TEST_F(Signed, AListThatNamesWhatLiesOutsideIsRefused) {
  for (const char* const name : {"../rt.toml", "/etc/passwd", "a/../rt.toml"}) {
    std::ofstream(folder.folder / kSumsFile, std::ios::app)
        << sha256(text_of(folder.folder / name)) << "  " << name << "\n";
    sign(folder.folder, key);
    EXPECT_EQ(check().exit, 3) << name;
    folder.seal();
  }
}

TEST_F(Signed, GarbageInsteadOfASignatureIsRefused) {
  const std::string good = text_of(folder.folder / kSignatureFile);
  const std::string bad[] = {"",
                             "\n",
                             "hello",
                             good + good,
                             good.substr(0, good.size() / 2),
                             std::string(1000, 'A'),
                             "plumb-ed25519 0123456789abcdef \n"};
  for (const std::string& text : bad) {
    std::ofstream(folder.folder / kSignatureFile) << text;
    refused("E-RT-SIGNATURE", "SHA256SUMS.sig is no signature: ");
  }
  std::string other = good;
  other[40] = other[40] == 'A' ? 'B' : 'A';
  std::ofstream(folder.folder / kSignatureFile) << other;
  refused("E-RT-SIGNATURE", "does not hold");
}

TEST_F(Signed, AKeyFileThatOthersMayWriteIsNotUsed) {
  for (const mode_t mode : {0666, 0664, 0646}) {
    ::chmod((machine.keys() / "anna.pub").c_str(), mode);
    const RtRan ran = check();
    EXPECT_EQ(ran.exit, 3);
    EXPECT_NE(ran.err.find("error[E-RT-SIGNER]"), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find("anna.pub is not used: it may be written by others than its owner"),
              std::string::npos)
        << ran.err;
  }
  ::chmod((machine.keys() / "anna.pub").c_str(), 0644);
  EXPECT_EQ(check().exit, 0);
  for (const fs::path& open : {machine.keys(), machine.etc()}) {
    ::chmod(open.c_str(), 0777);
    EXPECT_EQ(check().exit, 3) << open << " may be written by everybody";
    ::chmod(open.c_str(), 0755);
  }
  if (::geteuid() != 0) return;
  ASSERT_EQ(::chown((machine.keys() / "anna.pub").c_str(), 65534, 65534), 0);
  EXPECT_NE(check().err.find("anna.pub is not used: it belongs to user 65534, not to root"),
            std::string::npos);
}

TEST_F(Signed, ABrokenKeyFileIsOneWarningAndTheOthersCount) {
  std::ofstream(machine.keys() / "broken.pub") << "plumb-ed25519 AAAA\n";
  std::ofstream(machine.keys() / "private.pub") << text_of(machine.root / "anna.key");
  ASSERT_EQ(::mkfifo((machine.keys() / "pipe.pub").c_str(), 0644), 0);
  const RtRan ran = check();
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_NE(ran.err.find("warning[W-RT-KEYS]"), std::string::npos) << ran.err;
  EXPECT_NE(ran.err.find("broken.pub is no public key: it has no 32 bytes in base64"),
            std::string::npos)
      << ran.err;
  EXPECT_NE(ran.err.find("private.pub is no public key: it is a private key"), std::string::npos)
      << ran.err;
  EXPECT_NE(ran.err.find("pipe.pub: it is no regular file"), std::string::npos) << ran.err;
}

TEST_F(Signed, AnUnsignedFolderRunsOnlyWhereTheSettingsAllowItWhichIsSaidEverywhere) {
  fs::remove(folder.folder / kSignatureFile);
  machine.write("plumb-rt.toml", "unsigned = \"allowed\"\n");
  const RtRan ran = machine.rt({"run", folder.folder.string(), "--json"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_NE(ran.err.find("warning[W-RT-UNSIGNED]"), std::string::npos) << ran.err;
  EXPECT_NE(ran.err.find("  unsigned  note unsigned: "), std::string::npos)
      << "the journal and the log: " << ran.err;
  EXPECT_NE(ran.json()["result"]["install"]["note"].get<std::string>().find("allows it"),
            std::string::npos);
  const RtRan seen = machine.rt({"doctor"});
  EXPECT_NE(seen.out.find("signatures"), std::string::npos) << seen.out;
  EXPECT_NE(seen.out.find("demanded, but unsigned: "), std::string::npos) << seen.out;
  sign(folder.folder, machine.make_key("mallory"));
  refused("E-RT-SIGNER", "which is none of");
}

TEST_F(Signed, TheSettingCountsOnlyIfOthersCannotWriteIt) {
  fs::remove(folder.folder / kSignatureFile);
  machine.write("plumb-rt.toml", "unsigned = \"allowed\"\n");
  ::chmod((machine.etc() / "plumb-rt.toml").c_str(), 0666);
  refused("E-RT-KEYS", "plumb-rt.toml is not used: it may be written by others");
  machine.write("plumb-rt.toml", "unsigned = \"alowed\"\n");
  refused("E-RT-RANGE", "alowed");
  machine.write("plumb-rt.toml", "unsign = \"allowed\"\n");
  refused("E-RT-KEY", "unsign");
  machine.write("plumb-rt.toml", "unsigned = \"refused\"\n");
  refused("E-RT-UNSIGNED", "is not signed");
}

TEST_F(Signed, WithoutKeysAFolderRunsAndIsSaidToBeUnsigned) {
  fs::remove_all(machine.keys());
  fs::remove(folder.folder / kSignatureFile);
  const RtRan ran = machine.rt({"run", folder.folder.string(), "--json"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_EQ(ran.json()["result"]["install"]["note"],
            "unsigned: no keys are set up on this machine");
  EXPECT_NE(ran.err.find("note unsigned: no keys are set up on this machine"), std::string::npos);
  EXPECT_NE(machine.rt({"doctor"}).out.find("unsigned: no keys are set up"), std::string::npos);
}

TEST_F(Signed, TheEnvironmentDoesNotChangeWhatIsDemanded) {
  fs::remove(folder.folder / kSignatureFile);
  for (const char* const name : {"PLUMB_ETC", "ETC", "XDG_CONFIG_HOME"})
    ::setenv(name, "/nowhere", 1);
  refused("E-RT-UNSIGNED", "is not signed");
  for (const char* const name : {"PLUMB_ETC", "ETC", "XDG_CONFIG_HOME"}) ::unsetenv(name);
}

TEST_F(Signed, ASwapTakesOnlyAModelOfASignedFolder) {
  write_endless_targets(folder);
  sign(folder.folder, key);
  const Deployed better, loose;
  better.write_model("robot.plumb", other_arm(2e-4));
  RtProgram run({"run", folder.folder.string(), "--etc", machine.etc().string()}, machine.root);
  const auto ask = [&](std::vector<std::string> words) { return plumb_rt(words, machine.root); };
  ASSERT_TRUE(becomes([&] { return ask({"status", folder.folder.string()}).exit == 0; }));
  const auto swap = [&](const Deployed& from) {
    return ask({"swap", (from.folder / "robot.plumb").string(), "--dir", folder.folder.string()});
  };
  const RtRan refused_swap = swap(better);
  EXPECT_EQ(refused_swap.exit, 3);
  EXPECT_NE(refused_swap.err.find("error[E-RT-UNSIGNED]"), std::string::npos) << refused_swap.err;
  sign(better.folder, machine.make_key("mallory"));
  EXPECT_NE(swap(better).err.find("error[E-RT-SIGNER]"), std::string::npos);
  sign(better.folder, key);
  std::ofstream(better.folder / "extra") << "x";
  EXPECT_NE(swap(better).err.find("error[E-RT-FOLDER]"), std::string::npos);
  fs::remove(better.folder / "extra");
  const RtRan good = swap(better);
  EXPECT_EQ(good.exit, 0) << good.err;
  auto origin = ask({"status", folder.folder.string(), "--json"}).json()["result"]["install"];
  EXPECT_EQ(origin["signed_by"], "anna");
  fs::rename(machine.keys() / "anna.pub", machine.keys() / "anna.revoked");
  EXPECT_NE(swap(folder).err.find("error[E-RT-REVOKED]"), std::string::npos)
      << "a key that was revoked meanwhile";
  run.kill(SIGTERM);
  EXPECT_EQ(run.wait().exit, 0);
}

/// Another program, and only what the documents say of the format.
TEST_F(Signed, OpenSslVerifiesTheSignatureFromTheDocumentedFormatAlone) {
  if (std::system("openssl version > /dev/null 2>&1") != 0) GTEST_SKIP() << "no openssl here";
  const std::string root = machine.root.string();
  const std::string command =
      "set -e; cd " + root + "; deploy=" + folder.folder.string() +
      "\n"
      "read -r word pub comment < anna.pub; test $word = plumb-ed25519\n"
      "read -r word id sig < $deploy/SHA256SUMS.sig; test $word = plumb-ed25519\n"
      "echo $pub | base64 -d > pub.raw; test $(wc -c < pub.raw) = 32\n"
      "test $id = $(sha256sum < pub.raw | cut -c1-16)\n"
      "{ printf '\\060\\052\\060\\005\\006\\003\\053\\145\\160\\003\\041\\000'; cat pub.raw; } > "
      "pub.der\n"
      "{ printf 'plumb deploy folder 1\\n'; cat $deploy/SHA256SUMS; } > signed\n"
      "echo $sig | base64 -d > sig.raw\n"
      "openssl pkeyutl -verify -pubin -inkey pub.der -keyform DER -rawin -in signed -sigfile "
      "sig.raw\n"
      "printf x >> signed\n"
      "! openssl pkeyutl -verify -pubin -inkey pub.der -keyform DER -rawin -in signed -sigfile "
      "sig.raw\n"
      "(cd $deploy && sha256sum --quiet -c SHA256SUMS)\n";
  std::ofstream(machine.root / "verify.sh") << command;
  EXPECT_EQ(std::system(("sh " + root + "/verify.sh > " + root + "/said 2>&1").c_str()), 0)
      << text_of(machine.root / "said");
}

TEST(Metrics, SayWhatIsUnsignedAndWhatWaitsForARestart) {
  drivers::rt::RunFacts facts;
  facts.origin.note = "unsigned: no keys are set up on this machine";
  std::string text = metrics_text({}, facts);
  EXPECT_NE(text.find("\nplumb_unsigned 1\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\nplumb_restart_needed 0\n"), std::string::npos);
  facts.origin.note.clear();
  facts.origin.place = "/var/lib/plumb/cell4";
  facts.origin.version = "0123456789abcdef";
  facts.origin.current = "fedcba9876543210";
  facts.origin.key = "an\"na";
  text = metrics_text({}, facts);
  EXPECT_NE(text.find("\nplumb_unsigned 0\n"), std::string::npos);
  EXPECT_NE(text.find("\nplumb_restart_needed 1\n"), std::string::npos);
  EXPECT_NE(text.find("version=\"0123456789abcdef\",made=\"\",signed_by=\"an\\\"na\"} 1\n"),
            std::string::npos)
      << text;
}

TEST(SigningKey, TheFirstExampleOfRfc8032) {
  std::array<unsigned char, 32> seed{0x9d, 0x61, 0xb1, 0x9d, 0xef, 0xfd, 0x5a, 0x60,
                                     0xba, 0x84, 0x4a, 0xf4, 0x92, 0xec, 0x2c, 0xc4,
                                     0x44, 0x49, 0xc5, 0x69, 0x7b, 0x32, 0x69, 0x19,
                                     0x70, 0x3b, 0xac, 0x03, 0x1c, 0xae, 0x7f, 0x60};
  const SecretKey key =
      SecretKey::read("plumb-ed25519-secret " + base64(seed.data(), seed.size()) + " RFC 8032");
  const PublicKey shared = key.public_key();
  EXPECT_EQ(base64(shared.bytes.data(), shared.bytes.size()),
            "11qYAYKxCrfVS/7TyWQHOg7hcvPapiMlrwIaaPcHURo=");
  const auto signature = key.sign("");
  EXPECT_EQ(base64(signature.data(), signature.size()),
            "5VZDAMNgrHKQhuLMgG6CioSHfx645dl02HPgZSJJAVVfuIIVkKM7rMYeOXAc"
            "+bRr0lv18FlbviRlUUFDjnoQCw==");
  EXPECT_TRUE(verifies(signature, "", shared));
  EXPECT_FALSE(verifies(signature, "x", shared));
}

TEST(SigningKey, WhatIsNoKeyIsRefusedWithTheReason) {
  for (const char* const text :
       {"", "\n", "plumb-ed25519", "plumb-ed25519 ", "ssh-ed25519 AAAA", "plumb-ed25519 AAAA",
        "plumb-ed25519 11qYAYKxCrfVS/7TyWQHOg7hcvPapiMlrwIaaPcHURo",
        "plumb-ed25519 11qYAYKxCrfVS/7TyWQHOg7hcvPapiMlrwIaaPcHURo=\nplumb-ed25519 "
        "11qYAYKxCrfVS/7TyWQHOg7hcvPapiMlrwIaaPcHURo="})
    EXPECT_THROW(read_public_key(text), std::invalid_argument) << text;
  EXPECT_EQ(read_public_key("plumb-ed25519 11qYAYKxCrfVS/7TyWQHOg7hcvPapiMlrwIaaPcHURo= Anna B\r\n")
                .comment,
            "Anna B");
}

}  // namespace
}  // namespace plumb::tests
