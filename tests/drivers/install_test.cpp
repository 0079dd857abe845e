// SPDX-License-Identifier: Apache-2.0
// Places: install, rollback, list and verify, on a stopped plumb-rt and on one that runs.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <random>
#include <set>

#include "program/folder_lock.hpp"
#include "rt/install_history.hpp"
#include "rt/place.hpp"
#include "tests/drivers/killed_at.hpp"
#include "tests/drivers/rights.hpp"
#include "tests/drivers/signed_folder.hpp"

namespace plumb::tests {
namespace {

#ifdef __SANITIZE_ADDRESS__
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

namespace fs = std::filesystem;
using drivers::rt::InstallPlace;

/// A machine without keys, an empty place, and deploy folders that were made one after the other.
class Install : public testing::Test {
 protected:
  static constexpr const char* kFirst = "2026-11-25T10:00:00Z";
  static constexpr const char* kSecond = "2026-11-25T11:00:00Z";
  static constexpr const char* kThird = "2026-11-25T12:00:00Z";

  Install() {
    fs::remove_all(machine.keys());
    write_made(first, kFirst);
    second.write_model("robot.plumb", other_arm(2e-4));
    write_made(second, kSecond);
    third.write_model("robot.plumb", other_arm(3e-4));
    write_made(third, kThird);
  }

  RtRan rt(std::vector<std::string> words) const { return machine.rt(std::move(words)); }
  RtRan install(const Deployed& folder, std::vector<std::string> more = {}) const {
    std::vector<std::string> words{"install", folder.folder.string(), "--to", to(), "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return rt(words);
  }
  RtRan rollback(std::vector<std::string> more = {}) const {
    std::vector<std::string> words{"rollback", "--to", to(), "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return rt(words);
  }
  RtRan verify() const { return rt({"verify", "--to", to(), "--json"}); }
  nlohmann::json list() const {
    return plumb_rt({"list", "--to", to(), "--json"}, machine.root).json()["result"];
  }
  nlohmann::json status() const {
    return plumb_rt({"status", to(), "--json"}, machine.root).json()["result"];
  }
  std::string to() const { return place.folder.string(); }
  static std::string id_of(const Deployed& folder) {
    return sha256(folder.text("SHA256SUMS")).substr(0, 16);
  }
  std::string current() const { return drivers::rt::current_version_if_any(place); }

  /// Refused with this code and these words, and nothing has changed.
  void refused(const RtRan& ran, int exit, const std::string& code,
               const std::string& words) const {
    EXPECT_EQ(ran.exit, exit) << ran.err;
    EXPECT_NE(ran.err.find("error[" + code + "]"), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find(words), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find("= help: "), std::string::npos) << ran.err;
    for (const auto& entry : fs::directory_iterator(place.versions()))
      EXPECT_TRUE(drivers::rt::is_version_id(entry.path().filename().string())) << entry.path();
  }

  const Machine machine;
  const InstallPlace place{machine.root / "place"};
  const Deployed first, second, third;
};

TEST_F(Install, ThreeVersionsAndBackAgain) {
  const RtRan one = install(first);
  ASSERT_EQ(one.exit, 0) << one.err;
  EXPECT_EQ(one.json()["result"]["how"], "stopped");
  EXPECT_EQ(current(), id_of(first));
  ASSERT_EQ(install(second).exit, 0);
  ASSERT_EQ(install(third).exit, 0);
  EXPECT_EQ(current(), id_of(third));
  EXPECT_EQ(verify().exit, 0) << verify().err;
  const auto listed = list();
  ASSERT_EQ(listed["versions"].size(), 3U);
  EXPECT_EQ(listed["versions"][0]["version"], id_of(third));
  EXPECT_EQ(listed["versions"][0]["current"], true);
  EXPECT_EQ(listed["versions"][0]["made"], kThird);
  EXPECT_EQ(listed["versions"][0]["installed_by"], drivers::rt::user_name(::getuid()));
  EXPECT_EQ(listed["previous"], id_of(second));
  ASSERT_EQ(rollback().exit, 0);
  EXPECT_EQ(current(), id_of(second));
  ASSERT_EQ(rollback().exit, 0);
  EXPECT_EQ(current(), id_of(first)) << "further back, not forward again";
  const RtRan none = rollback();
  EXPECT_EQ(none.exit, 3);
  EXPECT_NE(none.err.find("error[E-RT-ROLLBACK]"), std::string::npos) << none.err;
  ASSERT_EQ(rollback({"--version", id_of(third)}).exit, 0);
  EXPECT_EQ(current(), id_of(third));
  EXPECT_EQ(rollback({"--version", "../../etc"}).exit, 3);
  EXPECT_EQ(list()["history"].size(), 6U);
}

TEST_F(Install, WhatIsInstalledIsTheCopyOfWhatWasListedReadableAndNotWritable) {
  std::ofstream(first.folder / "events.jsonl") << "{}\n";  // of a run in the folder itself
  ASSERT_EQ(install(first).exit, 0);
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(place.version(id_of(first)))) {
    names.insert(entry.path().filename().string());
    struct stat found {};
    ASSERT_EQ(::lstat(entry.path().c_str(), &found), 0);
    EXPECT_EQ(found.st_mode & 07777, 0444U) << entry.path();
  }
  EXPECT_EQ(names, (std::set<std::string>{"SHA256SUMS", "robot.plumb", "rt.toml", "targets.csv"}));
  EXPECT_EQ(fs::read_symlink(place.link()), "versions/" + id_of(first));
  const RtRan again = install(first);
  EXPECT_EQ(again.exit, 0);
  EXPECT_EQ(again.json()["result"]["how"], "nothing");
  EXPECT_EQ(list()["history"].size(), 1U);
}

TEST_F(Install, APlaceRunsItsCurrentVersionAndWritesNothingInIt) {
  write_made(first, kFirst, "[log]\nrecord = \"record.log\"\n");
  ASSERT_EQ(install(first).exit, 0);
  ASSERT_EQ(rt({"run", to(), "--check"}).exit, 0);
  const RtRan ran = rt({"run", to(), "--json"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  auto origin = ran.json()["result"]["install"];
  EXPECT_EQ(origin["version"], id_of(first));
  EXPECT_EQ(origin["made"], kFirst);
  EXPECT_NE(origin["installed_by"].get<std::string>().find(drivers::rt::user_name(::getuid())),
            std::string::npos);
  EXPECT_TRUE(fs::exists(place.folder / "corrected.csv"));
  EXPECT_TRUE(fs::exists(place.folder / "events.jsonl"));
  EXPECT_TRUE(fs::exists(place.folder / "record.log"));
  const RtRan replayed = plumb_rt({"replay", to()}, machine.root);
  EXPECT_EQ(replayed.exit, 0) << replayed.err;
  EXPECT_EQ(verify().exit, 0);
  const RtRan events = plumb_rt({"events", to()}, machine.root);
  EXPECT_NE(events.out.find("version " + id_of(first)), std::string::npos) << events.out;
  const RtRan seal = plumb_rt({"seal", to()}, machine.root);
  EXPECT_EQ(seal.exit, 3);
  EXPECT_NE(seal.err.find("what is installed is not edited"), std::string::npos) << seal.err;
  EXPECT_EQ(plumb_rt({"seal", place.version(id_of(first)).string()}, machine.root).exit, 3);
}

TEST_F(Install, AnOlderFolderIsRefusedUnlessItIsMeant) {
  ASSERT_EQ(install(second).exit, 0);
  refused(install(first), 3, "E-RT-OLDER", std::string("was made ") + kFirst);
  EXPECT_EQ(current(), id_of(second));
  EXPECT_EQ(install(first, {"--older"}).exit, 0);
  EXPECT_EQ(current(), id_of(first));
}

TEST_F(Install, AnOlderOneThatIsStillThereIsARollback) {
  ASSERT_EQ(install(first).exit, 0);
  ASSERT_EQ(install(second).exit, 0);
  const RtRan ran = install(first);
  EXPECT_EQ(ran.exit, 3);
  EXPECT_NE(ran.err.find("plumb-rt rollback --to "), std::string::npos) << ran.err;
  EXPECT_NE(ran.err.find("--version " + id_of(first)), std::string::npos) << ran.err;
}

TEST_F(Install, AFolderThatDoesNotSayWhenItWasMadeIsTheOldest) {
  const Deployed unknown(Deployed::csv("target_step_mm = 33\n"));
  ASSERT_EQ(install(unknown).exit, 0);
  ASSERT_EQ(install(first).exit, 0);
  const Deployed another(Deployed::csv("target_step_mm = 34\n"));
  refused(install(another), 3, "E-RT-OLDER", "does not say when it was made");
}

TEST_F(Install, AClockOf1970AndOf2099LeadToARefusalThatNamesTheClock) {
  ASSERT_EQ(install(first).exit, 0);
  write_made(second, "1970-01-01T00:00:10Z");
  refused(install(second), 3, "E-RT-OLDER", "the clock of the machine that made it was wrong");
  write_made(second, "2099-01-01T00:00:00Z");
  const RtRan future = install(second);
  EXPECT_EQ(future.exit, 0) << future.err;
  EXPECT_NE(future.err.find("warning[W-RT-CLOCK]"), std::string::npos) << future.err;
  refused(install(third), 3, "E-RT-OLDER",
          "a clock was wrong when 2099-01-01T00:00:00Z was made, or is wrong here");
  EXPECT_EQ(install(third, {"--older"}).exit, 0);
  write_made(third, "yesterday");
  EXPECT_NE(install(third).err.find("error[E-RT-RANGE]"), std::string::npos);
}

TEST_F(Install, TheLastFewStayAndNeverTheCurrentNorTheOneBefore) {
  std::vector<std::string> ids;
  for (int i = 0; i < 6; ++i) {
    write_made(first, "2026-11-25T10:00:0" + std::to_string(i) + "Z");
    const RtRan ran = install(first, {"--keep", "3"});
    ASSERT_EQ(ran.exit, 0) << ran.err;
    ids.push_back(id_of(first));
  }
  std::set<std::string> there;
  for (const auto& id : place.ids()) there.insert(id);
  EXPECT_EQ(there, (std::set<std::string>{ids[3], ids[4], ids[5]}));
  ASSERT_EQ(rollback({"--version", ids[3]}).exit, 0);
  write_made(first, "2026-11-25T10:00:09Z");
  ASSERT_EQ(install(first, {"--keep", "2"}).exit, 0);
  EXPECT_TRUE(fs::exists(place.version(ids[3]))) << "the one before";
  EXPECT_EQ(verify().exit, 0);
}

TEST_F(Install, AVersionThatRunsIsNotRemoved) {
  write_endless_targets(first);
  write_made(first, kFirst);
  ASSERT_EQ(install(first).exit, 0);
  RtProgram run({"run", to(), "--etc", machine.etc().string()}, machine.root);
  ASSERT_TRUE(becomes([&] { return status().is_object(); }));
  const std::string runs = id_of(first);
  for (int i = 0; i < 4; ++i) {
    write_made(second, "2026-11-25T11:00:0" + std::to_string(i) + "Z");
    const RtRan ran = install(second, {"--keep", "2", "--at-restart"});
    ASSERT_EQ(ran.exit, 0) << ran.err;
    EXPECT_EQ(ran.json()["result"]["how"], "at-restart");
  }
  EXPECT_TRUE(fs::exists(place.version(runs)));
  EXPECT_EQ(status()["install"]["version"], runs);
  EXPECT_EQ(status()["install"]["current"], id_of(second));
  EXPECT_EQ(status()["install"]["restart_needed"], true);
  EXPECT_NE(plumb_rt({"status", to()}, machine.root).out.find("is installed but not running"),
            std::string::npos);
  run.kill(SIGTERM);
  EXPECT_EQ(run.wait().exit, 0);
}

TEST_F(Install, WhatRunsSwapsAndARefusalLeavesBothAsTheyWere) {
  for (const Deployed* one : {&first, &second, &third}) write_endless_targets(*one);
  write_made(first, kFirst);
  write_made(second, kSecond);
  ASSERT_EQ(install(first).exit, 0);
  RtProgram run({"run", to(), "--etc", machine.etc().string()}, machine.root);
  ASSERT_TRUE(becomes([&] { return status().is_object(); }));
  const RtRan swapped = install(second);
  ASSERT_EQ(swapped.exit, 0) << swapped.err;
  EXPECT_EQ(swapped.json()["result"]["how"], "swapped");
  EXPECT_GT(swapped.json()["result"]["change_mm"], 0.0);
  EXPECT_EQ(status()["install"]["version"], id_of(second));
  EXPECT_EQ(status()["install"]["restart_needed"], false);
  EXPECT_EQ(status()["install"]["made"], kSecond);

  format::Model far = Deployed::arm();
  far.guard.max_correction_m = 0.009;
  for (auto& joint : far.calibrated.joints) joint.a += 2e-3;
  third.write_model("robot.plumb", far);
  write_made(third, kThird);
  refused(install(third), 3, "E-RT-CHANGE", "and 5.000 mm are allowed");
  EXPECT_EQ(current(), id_of(second));
  EXPECT_EQ(status()["install"]["version"], id_of(second));
  EXPECT_FALSE(fs::exists(place.version(id_of(third)))) << "nothing half done";
  EXPECT_EQ(list()["history"].size(), 2U);
  EXPECT_NE(text_of(place.history()).find("\"what\":\"refused\""), std::string::npos);
  EXPECT_EQ(install(third, {"--allow-change-mm", "20"}).exit, 0);
  EXPECT_EQ(status()["install"]["version"], id_of(third));

  write_made(first, "2026-11-25T13:00:00Z", "target_step_mm = 21\n");
  refused(install(first), 3, "E-RT-RESTART", "[limits] target_step_mm");
  EXPECT_EQ(current(), id_of(third));
  const RtRan back = rollback({"--allow-change-mm", "20"});
  EXPECT_EQ(back.exit, 0) << back.err;
  EXPECT_EQ(status()["install"]["version"], id_of(second));
  EXPECT_EQ(current(), id_of(second));
  const RtRan loose =
      plumb_rt({"swap", (first.folder / "robot.plumb").string(), "--dir", to()}, machine.root);
  EXPECT_NE(loose.err.find("error[E-RT-SWAP]"), std::string::npos) << loose.err;
  const RtRan events = plumb_rt({"events", to()}, machine.root);
  EXPECT_NE(events.out.find("by " + drivers::rt::user_name(::getuid())), std::string::npos)
      << events.out;
  run.kill(SIGTERM);
  EXPECT_EQ(run.wait().exit, 0);
  EXPECT_EQ(verify().exit, 0);
}

TEST_F(Install, AnotherRobotIsRefusedByWhatRuns) {
  write_endless_targets(first);
  write_made(first, kFirst);
  ASSERT_EQ(install(first).exit, 0);
  RtProgram run({"run", to(), "--etc", machine.etc().string()}, machine.root);
  ASSERT_TRUE(becomes([&] { return status().is_object(); }));
  format::Model other = Deployed::arm();
  other.serial = "UR-2";
  second.write_model("robot.plumb", other);
  write_endless_targets(second);
  write_made(second, kSecond);
  refused(install(second), 3, "E-RT-SERIAL", "UR-2");
  EXPECT_EQ(current(), id_of(first));
  run.kill(SIGTERM);
  EXPECT_EQ(run.wait().exit, 0);
  refused(install(second), 3, "E-RT-SERIAL", "was made for robot 'UR-2', and ");
}

/// Between the swap and the change of `current` the two differ. Both are sound, status says it, and
/// the next install brings them together.
TEST_F(Install, KilledWhileWhatRunsSwapsNothingIsLost) {
  if (kSanitized) GTEST_SKIP() << "hundreds of starts, each of which a sanitizer makes slow";
  for (const Deployed* one : {&first, &second}) write_endless_targets(*one);
  // On a busy machine these installs take half a minute.
  write_made_slow(first, kFirst);
  write_made_slow(second, kSecond);
  ASSERT_EQ(install(first).exit, 0);
  RtProgram run({"run", to(), "--etc", machine.etc().string()}, machine.root);
  ASSERT_TRUE(becomes([&] { return status().is_object(); }));
  int between = 0;
  KilledAt ran = KilledAt::kKilled;
  for (int call = 15; ran == KilledAt::kKilled && call < 100; ++call) {
    ran = run_killed_at(
        {"install", second.folder.string(), "--to", to(), "--etc", machine.etc().string()}, call,
        machine.root);
    if (ran == KilledAt::kImpossible) GTEST_SKIP() << "this machine lets nobody trace";
    ASSERT_EQ(verify().exit, 0);
    auto origin = status()["install"];
    ASSERT_TRUE(origin["version"] == id_of(first) || origin["version"] == id_of(second));
    ASSERT_EQ(origin["current"], current());
    ASSERT_EQ(origin["restart_needed"], origin["version"] != current());
    between += origin["version"] != current() ? 1 : 0;
    const RtRan back = install(first, {"--older"});
    ASSERT_EQ(back.exit, 0) << "call " << call << ": " << back.err;
    ASSERT_EQ(status()["install"]["version"], id_of(first));
    ASSERT_EQ(current(), id_of(first));
  }
  EXPECT_EQ(ran, KilledAt::kEnded);
  EXPECT_GE(between, 1) << "it was killed between the two at least once";
  run.kill(SIGTERM);
  EXPECT_EQ(run.wait().exit, 0);
}

TEST_F(Install, FoldersThatAreNotSoundLeaveNoTrace) {
  const auto links = [&](auto make) {
    const fs::path file = second.folder / "targets.csv", aside = machine.root / "aside";
    fs::rename(file, aside);
    make(aside, file);
    const RtRan ran = install(second);
    EXPECT_EQ(ran.exit, 3) << ran.err;
    fs::remove(file);
    fs::rename(aside, file);
    return ran.err;
  };
  EXPECT_NE(links([](auto a, auto b) { fs::create_symlink(a, b); }).find("is a symbolic link"),
            std::string::npos);
  EXPECT_NE(links([](auto a, auto b) { fs::create_hard_link(a, b); }).find("has several names"),
            std::string::npos);
  EXPECT_NE(links([](auto, auto b) { ::mkfifo(b.c_str(), 0600); }).find("is missing"),
            std::string::npos)
      << "a pipe is no file";
  std::ofstream(second.folder / "more") << "x";
  EXPECT_NE(install(second).err.find("more stands in the folder"), std::string::npos);
  fs::remove(second.folder / "more");
  std::ofstream(second.folder / "targets.csv", std::ios::app) << "\n";
  EXPECT_NE(install(second).err.find("error[E-RT-SUMS]"), std::string::npos);
  EXPECT_FALSE(fs::exists(place.folder)) << "no place is left for what was refused";
}

TEST_F(Install, AMachineThatDemandsSignaturesInstallsOnlyWhatIsSigned) {
  fs::create_directory(machine.keys());
  ::chmod(machine.keys().c_str(), 0755);
  const SecretKey key = machine.trusted_key("anna");
  EXPECT_NE(install(first).err.find("error[E-RT-UNSIGNED]"), std::string::npos);
  EXPECT_FALSE(fs::exists(place.folder));
  sign(first.folder, key);
  sign(second.folder, key);
  ASSERT_EQ(install(first).exit, 0);
  ASSERT_EQ(install(second).exit, 0);
  EXPECT_EQ(list()["versions"][0]["signed_by"], "anna");
  EXPECT_EQ(verify().exit, 0);
  fs::rename(machine.keys() / "anna.pub", machine.keys() / "anna.revoked");
  refused(rollback(), 3, "E-RT-REVOKED", "signed by key anna, which is revoked");
  EXPECT_EQ(current(), id_of(second));
  EXPECT_EQ(verify().exit, 3);
  EXPECT_EQ(rt({"run", to(), "--check"}).exit, 3);
  const SecretKey next = machine.trusted_key("berta");
  sign(second.folder, next);
  ASSERT_EQ(install(second).exit, 0) << "the same folder, signed anew, mends the version";
  EXPECT_EQ(rt({"run", to(), "--check"}).exit, 0);
}

TEST_F(Install, VerifyFindsWhatWasChangedInThePlace) {
  ASSERT_EQ(install(first).exit, 0);
  ASSERT_EQ(install(second).exit, 0);
  const fs::path version = place.version(id_of(first));
  const auto finds = [&](const std::string& words) {
    const RtRan ran = verify();
    EXPECT_EQ(ran.exit, 3);
    EXPECT_NE(ran.err.find(words), std::string::npos) << ran.err;
  };
  ::chmod(version.c_str(), 0755);
  std::ofstream(version / "events.jsonl") << "x";
  finds("events.jsonl stands in the folder");
  fs::remove(version / "events.jsonl");
  ::chmod((version / "rt.toml").c_str(), 0644);
  const std::string toml = text_of(version / "rt.toml");
  std::ofstream(version / "rt.toml") << toml << "\n";
  finds("rt.toml is not the file that SHA256SUMS lists");
  refused(rollback(), 3, "E-RT-SUMS", "rt.toml is not the file");
  std::ofstream(version / "rt.toml") << toml;
  EXPECT_EQ(verify().exit, 0) << verify().err;
  ::chmod(version.c_str(), 0777);
  finds("may be written by others than its owner");
  ::chmod(version.c_str(), 0555);
  ::chmod(place.folder.c_str(), 0777);
  finds("may be written by others than its owner");
  EXPECT_EQ(rt({"run", to(), "--check"}).exit, 3);
  ::chmod(place.folder.c_str(), 0755);
  fs::remove(place.link());
  fs::create_symlink("/etc", place.link());
  finds("which is no version");
  fs::remove(place.link());
  fs::create_symlink("versions/0123456789abcdef", place.link());
  finds("which is not there");
  EXPECT_EQ(rt({"run", to(), "--check"}).exit, 3);
  EXPECT_EQ(install(second).exit, 0) << "an install mends it";
  EXPECT_EQ(verify().exit, 0);
}

TEST_F(Install, ATornOrForeignLineOfTheHistoryIsPassedOver) {
  ASSERT_EQ(install(first).exit, 0);
  std::ofstream(place.history(), std::ios::app) << "garbage\n{\"version\": 3}\n{\"time\": \"2026";
  ASSERT_EQ(install(second).exit, 0);
  const RtRan ran = verify();
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_EQ(ran.json()["result"]["damaged"], 3);
  EXPECT_EQ(list()["history"].size(), 2U);
  fs::remove(place.history());
  EXPECT_EQ(list()["current"], id_of(second));
  EXPECT_EQ(install(third).exit, 0);
  EXPECT_EQ(rollback().exit, 0);
  EXPECT_EQ(current(), id_of(second));
}

TEST_F(Install, TwoAtOnceWaitForEachOther) {
  ASSERT_EQ(install(first).exit, 0);
  {
    const FolderLock held(place.versions());
    refused(install(second), 5, "E-RT-INSTALLING", "another install or rollback works in");
  }
  EXPECT_EQ(current(), id_of(first));
  const auto words = [&](const Deployed& folder) {
    return std::vector<std::string>{"install", folder.folder.string(), "--to", to(), "--older",
                                    "--etc",   machine.etc().string()};
  };
  for (int i = 0; i < 5; ++i) {
    RtProgram a(words(second), machine.root), b(words(third), machine.root);
    EXPECT_EQ(a.wait().exit, 0);
    EXPECT_EQ(b.wait().exit, 0);
    EXPECT_EQ(verify().exit, 0);
  }
}

/// A file that may not grow stands for a disk that is full: EFBIG instead of ENOSPC.
TEST_F(Install, AFullDiskLeavesTheOldOne) {
  ASSERT_EQ(install(first).exit, 0);
  const auto words = [&] {
    return std::vector<std::string>{"install", second.folder.string(), "--to", to(),
                                    "--etc",   machine.etc().string()};
  };
  for (const rlim_t bytes : {0, 100, 2000}) {
    RtProgram full(words(), machine.root, [bytes] {
      ::signal(SIGXFSZ, SIG_IGN);
      const int keep = ::open("/dev/null", O_WRONLY);
      ::dup2(keep, STDOUT_FILENO);
      set_limit(RLIMIT_FSIZE, bytes);
    });
    const RtRan ran = full.wait();
    EXPECT_NE(ran.exit, 0) << bytes;
    EXPECT_EQ(current(), id_of(first));
    EXPECT_EQ(verify().exit, 0);
    EXPECT_EQ(place.ids().size(), 1U) << "nothing half done";
  }
  std::ofstream(place.history(), std::ios::app) << std::string(20'000, ' ') << "\n";
  RtProgram full(words(), machine.root, [] {
    ::signal(SIGXFSZ, SIG_IGN);
    set_limit(RLIMIT_FSIZE, 20'000);
  });
  const RtRan ran = full.wait();
  EXPECT_EQ(ran.exit, 5) << "no room for the line that says what was installed";
  EXPECT_NE(ran.err.find("installs.jsonl: File too large"), std::string::npos) << ran.err;
  EXPECT_EQ(current(), id_of(first));
  EXPECT_EQ(place.ids().size(), 1U) << "nothing half done";
  EXPECT_EQ(install(second).exit, 0);
}

/// A real disk of 256 kB and one that is read only, where the test may mount them.
TEST_F(Install, ADiskThatIsFullOrReadOnlyIsSaid) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root may mount";
  const fs::path disk = machine.root / "disk";
  fs::create_directory(disk);
  if (::mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=128k") != 0)
    GTEST_SKIP() << "this machine lets nobody mount";
  const std::string small = (disk / "place").string();
  const auto into = [&](const Deployed& folder) {
    return rt({"install", folder.folder.string(), "--to", small});
  };
  const RtRan one = into(first);
  EXPECT_EQ(one.exit, 0) << one.err;
  write_endless_targets(second);
  write_made(second, kSecond);
  const RtRan full = into(second);
  EXPECT_EQ(full.exit, 5);
  EXPECT_NE(full.err.find("No space left on device"), std::string::npos) << full.err;
  EXPECT_EQ(rt({"verify", "--to", small}).exit, 0);
  EXPECT_EQ(InstallPlace{small}.ids().size(), 1U);
  EXPECT_EQ(::mount("tmpfs", disk.c_str(), "tmpfs", MS_REMOUNT | MS_RDONLY, nullptr), 0);
  const RtRan fixed = into(third);
  EXPECT_EQ(fixed.exit, 5);
  EXPECT_NE(fixed.err.find("Read-only file system"), std::string::npos) << fixed.err;
  EXPECT_EQ(rt({"verify", "--to", small}).exit, 0);
  EXPECT_EQ(plumb_rt({"list", "--to", small}, machine.root).exit, 0);
  ::umount(disk.c_str());
}

TEST_F(Install, WhoeverMayNotWriteThePlaceMayNotInstall) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can become another user";
  ASSERT_EQ(install(first).exit, 0);
  for (const auto& folder : {machine.root, second.folder}) ::chmod(folder.c_str(), 0755);
  RtProgram other(
      {"install", second.folder.string(), "--to", to(), "--etc", machine.etc().string()},
      machine.root, [] { become_nobody(); });
  const RtRan ran = other.wait();
  EXPECT_EQ(ran.exit, 5) << ran.err;
  EXPECT_NE(ran.err.find("Permission denied"), std::string::npos) << ran.err;
  EXPECT_EQ(current(), id_of(first));
  EXPECT_EQ(verify().exit, 0);
}

/// Killed before each system call that changes a file, one after the other, the place is whole and
/// at the old version or at the new one, and the next install works.
TEST_F(Install, KilledBeforeEveryCallThatChangesAFileThePlaceIsWhole) {
  if (kSanitized) GTEST_SKIP() << "hundreds of starts, each of which a sanitizer makes slow";
  const auto words = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"--to", to(), "--etc", machine.etc().string()});
    return more;
  };
  int last_change = 0;
  const auto kill_at_each = [&](const std::vector<std::string>& verb, bool both) {
    int calls = 0;
    for (bool killed = true; killed; ++calls) {
      fs::remove_all(place.folder);
      ASSERT_EQ(install(first).exit, 0);
      if (both) {
        ASSERT_EQ(install(second).exit, 0);
      }
      const std::string before = current();
      const std::string next = both ? id_of(first) : id_of(second);
      const KilledAt ran = run_killed_at(words(verb), calls, machine.root);
      if (ran == KilledAt::kImpossible) GTEST_SKIP() << "this machine lets nobody trace";
      killed = ran == KilledAt::kKilled;
      const std::string after = current();
      ASSERT_TRUE(after == before || after == next) << "call " << calls << ": " << after;
      if (after == before) last_change = calls;
      ASSERT_EQ(verify().exit, 0) << "call " << calls << ": " << verify().err;
      ASSERT_EQ(list()["current"], after);
      ASSERT_EQ(install(third).exit, 0) << "call " << calls;
      ASSERT_EQ(rollback().exit, 0);
      ASSERT_EQ(current(), after) << "call " << calls << ": back to what was current then";
      for (const auto& entry : fs::directory_iterator(place.versions()))
        ASSERT_TRUE(drivers::rt::is_version_id(entry.path().filename().string()));
    }
    std::cout << verb.front() << ": killed before each of " << calls - 1
              << " calls; current changes with number " << last_change + 1 << "\n";
    EXPECT_GT(calls, 5);
    EXPECT_GT(last_change, 2);
  };
  kill_at_each({"install", second.folder.string()}, false);
  kill_at_each({"rollback"}, true);
}

/// The same at moments by chance, of installs and rollbacks in a row.
TEST_F(Install, KilledAnywhereThePlaceIsWhole) {
  if (kSanitized) GTEST_SKIP() << "hundreds of starts, each of which a sanitizer makes slow";
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(install(first).exit, 0);
  const auto usual = std::chrono::duration_cast<std::chrono::microseconds>(
                         std::chrono::steady_clock::now() - begin)
                         .count();
  std::mt19937 random(7);
  const int rounds = 200;
  int killed = 0, changed = 0;
  const Deployed* const folders[] = {&first, &second, &third};
  for (int i = 0; i < rounds; ++i) {
    const std::string before = current();
    const Deployed& next = *folders[random() % 3];
    const bool back = random() % 3 == 0;
    std::vector<std::string> words =
        back ? std::vector<std::string>{"rollback", "--to", to()}
             : std::vector<std::string>{
                   "install", next.folder.string(), "--to", to(), "--older", "--keep", "2"};
    words.insert(words.end(), {"--etc", machine.etc().string()});
    RtProgram run(words, machine.root);
    std::this_thread::sleep_for(std::chrono::microseconds(random() % (1 + 5 * usual / 2)));
    run.kill(SIGKILL);
    killed += run.wait().exit == -1 ? 1 : 0;
    const std::string after = current();
    changed += after != before ? 1 : 0;
    EXPECT_TRUE(back || after == before || after == id_of(next)) << i;
    const RtRan seen = verify();
    ASSERT_EQ(seen.exit, 0) << "round " << i << ": " << seen.err;
  }
  std::cout << rounds << " rounds, " << killed << " killed, current changed " << changed
            << " times\n";
  EXPECT_GT(killed, rounds / 20);
  EXPECT_GT(changed, rounds / 20);
  EXPECT_EQ(install(second, {"--older"}).exit, 0);
  EXPECT_EQ(current(), id_of(second));
  for (const auto& entry : fs::directory_iterator(place.versions()))
    EXPECT_TRUE(drivers::rt::is_version_id(entry.path().filename().string())) << entry.path();
}

TEST(FindPlace, WithoutANameTheOnlyPlaceIsMeant) {
  const Machine machine;
  const fs::path store = machine.root / "store";
  const auto found = [&](const std::string& to) {
    try {
      return drivers::rt::find_place(to, store).folder.string();
    } catch (const Failure& failure) {
      return failure.problems().front().message;
    }
  };
  EXPECT_NE(found("").find("there is no place below"), std::string::npos);
  fs::create_directories(store / "cell4/versions");
  fs::create_directories(store / "plain");
  EXPECT_EQ(found(""), (store / "cell4").string());
  EXPECT_EQ(found("other"), (store / "other").string());
  EXPECT_EQ(found("./other"), "./other");
  fs::create_directories(store / "cell5/versions");
  EXPECT_NE(found("").find("several places below"), std::string::npos);
  EXPECT_NE(found("").find("cell4, cell5"), std::string::npos);
  for (const char* const bad : {"..", ".x", "-x", "a b", "a\nb"})
    EXPECT_NE(found(bad).find("cannot be the name of a place"), std::string::npos) << bad;
}

}  // namespace
}  // namespace plumb::tests
