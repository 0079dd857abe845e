// SPDX-License-Identifier: Apache-2.0
// plumb-rt run as a user meets it, on targets from a file.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <algorithm>

#include "tests/drivers/deployed.hpp"
#include "tests/drivers/rt_program.hpp"

namespace plumb::tests {
namespace {

/// Targets that go on for longer than a test.
void write_long_targets(const Deployed& folder) {
  std::string rows;
  const std::string first = folder.text("targets.csv");
  const std::size_t header = first.find('\n') + 1;
  const std::string row = first.substr(header, first.find('\n', header) + 1 - header);
  for (int i = 0; i < 30'000; ++i) rows += row;
  folder.write("targets.csv", first.substr(0, header) + rows);
}

nlohmann::json status(const Deployed& folder) {
  return plumb_rt({"status", folder.folder.string(), "--json"}, folder.folder).json();
}

bool is_active(const Deployed& folder) {
  auto json = status(folder);
  return json.is_object() && json["result"].is_object() && json["result"]["state"] == "active";
}

TEST(Run, PlaysAFileToItsEndAndReplaysToTheBit) {
  const Deployed folder(Deployed::csv("[log]\nrecord = \"record.log\"\n"));
  const RtRan ran = plumb_rt({"run", folder.folder.string(), "--json"}, folder.folder);
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_EQ(ran.json()["result"]["counters"]["faults"], 0);
  EXPECT_GT(ran.json()["result"]["counters"]["answered"], Deployed::kTargets);
  const std::string answers = folder.text("corrected.csv");
  EXPECT_EQ(answers.rfind("t_s,counter,cx_mm", 0), 0U);
  EXPECT_GT(std::count(answers.begin(), answers.end(), '\n'), Deployed::kTargets);
  const std::string record = (folder.folder / "record.log").string();
  const RtRan replayed =
      plumb_rt({"replay", record, "--dir", folder.folder.string(), "--json"}, folder.folder);
  EXPECT_EQ(replayed.exit, 0) << replayed.err;
  EXPECT_EQ(replayed.json()["result"]["same"], true) << replayed.out;
  EXPECT_GT(replayed.json()["result"]["frames"], 100);
}

TEST(Run, ACheckWritesNothingSoThatTheRunAfterItStarts) {
  const Deployed folder(Deployed::csv("[log]\nrecord = \"record.log\"\n"));
  const std::vector<std::string> check{"run", folder.folder.string(), "--check"};
  const RtRan checked = plumb_rt(check, folder.folder);
  EXPECT_EQ(checked.exit, 0) << checked.err;
  for (const auto* made : {"record.log", "corrected.csv"})
    EXPECT_FALSE(std::filesystem::exists(folder.folder / made)) << made;
  const RtRan ran = plumb_rt({"run", folder.folder.string()}, folder.folder);
  EXPECT_EQ(ran.exit, 0) << ran.err;
  const RtRan after = plumb_rt(check, folder.folder);
  EXPECT_EQ(after.exit, 5) << "the answers are there already, and a run would not replace them";
  EXPECT_NE(after.err.find("E-RT-SINK"), std::string::npos) << after.err;
}

TEST(Run, ACheckFindsARecordThatCannotBeMade) {
  const Deployed folder(Deployed::csv("[log]\nrecord = \"gone/record.log\"\n"));
  const RtRan checked = plumb_rt({"run", folder.folder.string(), "--check"}, folder.folder);
  EXPECT_EQ(checked.exit, 5);
  EXPECT_NE(checked.err.find("E-RT-RECORD"), std::string::npos) << checked.err;
  EXPECT_NE(checked.err.find("No such file or directory"), std::string::npos) << checked.err;
}

TEST(Run, AReplayWithAnotherModeDiffers) {
  const Deployed folder(Deployed::csv("[log]\nrecord = \"record.log\"\n"));
  ASSERT_EQ(plumb_rt({"run", folder.folder.string()}, folder.folder).exit, 0);
  std::string toml = folder.text("rt.toml");
  toml.replace(toml.find("\"full\""), 6, "\"limited\"");
  folder.write("rt.toml", toml);
  const std::string record = (folder.folder / "record.log").string();
  const RtRan replayed =
      plumb_rt({"replay", record, "--dir", folder.folder.string()}, folder.folder);
  EXPECT_EQ(replayed.exit, 1);
  EXPECT_NE(replayed.err.find("E-RT-REPLAY-DIFFERS"), std::string::npos) << replayed.err;
}

TEST(Run, RampsOutOnTheFirstSignal) {
  const Deployed folder;
  write_long_targets(folder);
  RtProgram run({"run", folder.folder.string(), "--json"}, folder.folder);
  ASSERT_TRUE(becomes([&] { return is_active(folder); }));
  run.kill(SIGTERM);
  const RtRan ran = run.wait();
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_GT(ran.json()["result"]["counters"]["answered"], 50);
  EXPECT_EQ(ran.json()["result"]["correction"]["applied_um"], 0.0);
  const RtRan gone = plumb_rt({"status", folder.folder.string()}, folder.folder);
  EXPECT_EQ(gone.exit, 5);
  EXPECT_NE(gone.err.find("E-RT-NOT-RUNNING"), std::string::npos) << gone.err;
}

TEST(Run, ASecondSignalEndsAtOnceAndTheNextRunStartsAsEver) {
  const Deployed folder(Deployed::csv("[log]\nrecord = \"record.log\"\n"));
  format::Model slow = Deployed::arm();
  slow.guard.ramp_s = 10.0;
  folder.write_model("robot.plumb", slow);
  write_long_targets(folder);
  RtProgram run({"run", folder.folder.string(), "--json"}, folder.folder);
  const auto is = [&](const char* state, double more_than_um) {
    auto json = status(folder);
    return json.is_object() && json["ok"] == true && json["result"]["state"] == state &&
           json["result"]["correction"]["applied_um"] > more_than_um;
  };
  ASSERT_TRUE(becomes([&] { return is("active", 200.0); }));
  run.kill(SIGTERM);
  ASSERT_TRUE(becomes([&] { return is("hold", 100.0); })) << "it ramps out, for seconds";
  const auto begin = std::chrono::steady_clock::now();
  run.kill(SIGTERM);
  const RtRan ran = run.wait();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(1));
  EXPECT_EQ(ran.exit, 130);
  EXPECT_NE(ran.err.find("ended at once; it is the receiver that takes the correction away"),
            std::string::npos)
      << ran.err;
  EXPECT_EQ(ran.json()["ok"], false) << "one object all the same: " << ran.out;
  EXPECT_EQ(ran.json()["error"]["code"], "E-INTERRUPTED");
  const std::string record = folder.text("record.log");
  EXPECT_EQ(record.back(), '\n') << "the last line is whole";
  const RtRan replayed =
      plumb_rt({"replay", (folder.folder / "record.log").string(), "--dir", folder.folder.string()},
               folder.folder);
  EXPECT_EQ(replayed.exit, 0) << replayed.err;
  EXPECT_EQ(plumb_rt({"status", folder.folder.string()}, folder.folder).exit, 5);
  std::filesystem::remove(folder.folder / "corrected.csv");  // which is never replaced
  const RtRan again = plumb_rt({"run", folder.folder.string(), "--check"}, folder.folder);
  EXPECT_EQ(again.exit, 0) << again.err;
}

TEST(Run, SwapsAModelAndRefusesGarbageAndOtherRobots) {
  const Deployed folder;
  write_long_targets(folder);
  RtProgram run({"run", folder.folder.string(), "--json"}, folder.folder);
  ASSERT_TRUE(becomes([&] { return is_active(folder); }));
  const auto swap = [&](const std::string& file) {
    return plumb_rt({"swap", (folder.folder / file).string(), "--dir", folder.folder.string()},
                    folder.folder);
  };
  format::Model better = Deployed::arm();
  for (auto& joint : better.calibrated.joints) joint.a -= 2e-4;
  folder.write_model("better.plumb", better);
  better.nominal.joints[0].a += 0.1;
  folder.write_model("set-up.plumb", better);
  better.serial = "UR-2";
  folder.write_model("other.plumb", better);
  EXPECT_NE(swap("targets.csv").err.find("E-RT-MODEL"), std::string::npos);
  EXPECT_NE(swap("other.plumb").err.find("E-RT-SERIAL"), std::string::npos);
  EXPECT_NE(swap("set-up.plumb").err.find("E-RT-SWAP"), std::string::npos);
  EXPECT_EQ(swap("missing.plumb").exit, 3);
  format::Model wide = Deployed::arm();
  wide.guard.max_correction_m = 0.02;
  folder.write_model("wide.plumb", wide);
  const RtRan wider = swap("wide.plumb");
  EXPECT_NE(wider.err.find("E-RT-CEILING"), std::string::npos) << wider.err;
  EXPECT_NE(wider.err.find("up to 20 mm, and [limits] max_correction_mm is 10"), std::string::npos)
      << wider.err;
  format::Model far = Deployed::arm();
  far.guard.max_correction_m = 0.009;
  for (auto& joint : far.calibrated.joints) joint.a += 2e-3;
  folder.write_model("far.plumb", far);
  const RtRan changed = swap("far.plumb");
  EXPECT_NE(changed.err.find("E-RT-CHANGE"), std::string::npos) << changed.err;
  EXPECT_NE(changed.err.find("and 5.000 mm are allowed"), std::string::npos) << changed.err;
  EXPECT_EQ(status(folder)["result"]["counters"]["swaps"], 0);
  auto limits = status(folder)["result"]["limits"];
  EXPECT_NEAR(limits["correction_mm"]["model"].get<double>(), 3.0, 1e-9);
  EXPECT_NEAR(limits["correction_mm"]["ceiling"].get<double>(), 10.0, 1e-9);
  EXPECT_EQ(swap("better.plumb").exit, 0);
  EXPECT_EQ(swap("robot.plumb").exit, 0);
  EXPECT_TRUE(becomes([&] { return status(folder)["result"]["counters"]["swaps"] == 2; }));
  EXPECT_TRUE(becomes([&] { return is_active(folder); }));
  const RtRan meant = plumb_rt({"swap", (folder.folder / "far.plumb").string(), "--dir",
                                folder.folder.string(), "--allow-change-mm", "20"},
                               folder.folder);
  EXPECT_EQ(meant.exit, 0) << meant.err;
  EXPECT_NE(meant.out.find("changes corrections by"), std::string::npos) << meant.out;
  const RtRan second = plumb_rt({"run", folder.folder.string()}, folder.folder);
  EXPECT_EQ(second.exit, 5);
  EXPECT_NE(second.err.find("E-RT-RUNNING"), std::string::npos) << second.err;
  const RtRan seen = plumb_rt({"monitor", folder.folder.string(), "--once"}, folder.folder);
  EXPECT_EQ(seen.exit, 0);
  EXPECT_NE(seen.out.find("cycles/s"), std::string::npos) << seen.out;
  run.kill(SIGTERM);
  EXPECT_EQ(run.wait().exit, 0);
}

std::vector<nlohmann::json> events(const Deployed& folder) {
  return plumb_rt({"events", folder.folder.string(), "--json"}, folder.folder)
      .json()["result"]["events"];
}

TEST(Run, TheJournalHoldsStatesSwapsAndRefusalsWithBothTimes) {
  const Deployed folder;
  write_long_targets(folder);
  folder.write_model("better.plumb", Deployed::arm());
  RtProgram run({"run", folder.folder.string()}, folder.folder);
  ASSERT_TRUE(becomes([&] { return is_active(folder); }));
  const auto swap = [&](const char* file) {
    return plumb_rt({"swap", (folder.folder / file).string(), "--dir", folder.folder.string()},
                    folder.folder);
  };
  EXPECT_EQ(swap("better.plumb").exit, 0);
  const RtRan garbage = swap("targets.csv");
  EXPECT_EQ(garbage.exit, 3) << garbage.err;
  const RtRan second = plumb_rt({"run", folder.folder.string()}, folder.folder);
  EXPECT_EQ(second.exit, 5);
  run.kill(SIGTERM);
  const RtRan ended = run.wait();
  EXPECT_EQ(ended.exit, 0);
  std::string course;
  double before_s = 0.0;
  for (const auto& event : events(folder)) {
    const std::string name = event["event"];
    course += name + (name == "state" ? ":" + event["to"].get<std::string>() : "") + " ";
    EXPECT_EQ(event["time"].get<std::string>().size(), 24U) << event;
    // What the cycle saw is written by a thread that a busy machine may hold back.
    EXPECT_GE(event["monotonic_s"].get<double>(), before_s - 2.0) << event;
    before_s = event["monotonic_s"].get<double>();
  }
  std::size_t at = 0;
  for (const char* const part : {"start", "state:sync", "state:shadow", "state:active", "swap ",
                                 "swap-refused", "not-started", "state:hold", "end"}) {
    at = course.find(part, at);
    ASSERT_NE(at, std::string::npos) << part << " in " << course;
  }
  EXPECT_NE(ended.err.find("state  from shadow  to active"), std::string::npos) << ended.err;
}

TEST(Run, AStoppedOneKeepsItsFolder) {
  const Deployed folder;
  write_long_targets(folder);
  RtProgram run({"run", folder.folder.string()}, folder.folder);
  ASSERT_TRUE(becomes([&] { return is_active(folder); }));
  run.kill(SIGSTOP);
  const RtRan second = plumb_rt({"run", folder.folder.string()}, folder.folder);
  EXPECT_EQ(second.exit, 5);
  EXPECT_NE(second.err.find("E-RT-RUNNING"), std::string::npos) << second.err;
  run.kill(SIGCONT);
  EXPECT_TRUE(becomes([&] { return status(folder).is_object(); })) << "it has kept its socket";
  run.kill(SIGTERM);
  EXPECT_EQ(run.wait().exit, 0);
}

TEST(Run, ARecordWithSwapsReplaysWithTheModelsThatItWentBy) {
  const Deployed folder(Deployed::csv("[log]\nrecord = \"record.log\"\n"));
  write_long_targets(folder);
  format::Model better = Deployed::arm();
  for (auto& joint : better.calibrated.joints) joint.a -= 2e-4;
  folder.write_model("better.plumb", better);
  folder.write_model("first.plumb", Deployed::arm());
  const auto file = [&](const char* name) { return (folder.folder / name).string(); };
  const auto ask = [&](std::vector<std::string> words) {
    words.insert(words.end(), {"--dir", folder.folder.string(), "--json"});
    return plumb_rt(words, folder.folder);
  };
  RtProgram run({"run", folder.folder.string(), "--json"}, folder.folder);
  ASSERT_TRUE(becomes([&] { return is_active(folder); }));
  for (const char* const next : {"better.plumb", "first.plumb", "better.plumb"})
    EXPECT_EQ(ask({"swap", file(next)}).exit, 0);
  run.kill(SIGTERM);
  ASSERT_EQ(run.wait().exit, 0);

  const RtRan alone = ask({"replay", file("record.log")});
  EXPECT_EQ(alone.exit, 1);
  EXPECT_NE(alone.err.find("it goes on with model"), std::string::npos) << alone.err;
  EXPECT_NE(alone.err.find("--model FILE"), std::string::npos) << alone.err;
  const RtRan with = ask({"replay", file("record.log"), "--model", file("better.plumb")});
  EXPECT_EQ(with.exit, 0) << with.err;
  EXPECT_EQ(with.json()["result"]["swaps"], 3);
  EXPECT_GT(with.json()["result"]["cycles"], alone.json()["result"]["cycles"]);
  folder.write_model("robot.plumb", better);  // as one leaves it who was content with the swap
  const RtRan later = ask({"replay", file("record.log"), "--model", file("first.plumb")});
  EXPECT_EQ(later.exit, 0) << later.err;
  EXPECT_EQ(later.json()["result"]["swaps"], 3);
}

RtRan replay(const Deployed& folder, std::vector<std::string> words) {
  words.insert(words.begin(), "replay");
  words.insert(words.end(), {"--dir", folder.folder.string(), "--json"});
  return plumb_rt(words, folder.folder);
}

bool has_event(const Deployed& folder, const std::string& name, const std::string& reason = "") {
  for (const auto& event : events(folder))
    if (event["event"] == name && event.value("reason", "").find(reason) != std::string::npos)
      return true;
  return false;
}

/// A file that may not grow stands for a disk that is full: EFBIG instead of ENOSPC.
TEST(Run, AFullDiskMakesAPauseInTheRecordAndNothingElse) {
  const Deployed folder(Deployed::csv("[log]\nrecord = \"record.log\"\n"));
  write_long_targets(folder);
  RtProgram run({"run", folder.folder.string(), "--json"}, folder.folder, [] {
    const rlimit limit{20'000, RLIM_INFINITY};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    ::signal(SIGXFSZ, SIG_IGN);
  });
  ASSERT_TRUE(becomes([&] { return has_event(folder, "record-paused", "File too large"); }));
  EXPECT_TRUE(becomes([&] { return is_active(folder); })) << "the run goes on";
  auto paused = status(folder)["result"];
  EXPECT_NE(paused["record"]["failure"].get<std::string>().find("File too large"),
            std::string::npos)
      << paused["record"];
  const std::string record = folder.text("record.log");
  EXPECT_GT(record.size(), 10'000U);
  EXPECT_EQ(record.back(), '\n') << "the last line is whole";
  const rlimit more{RLIM_INFINITY, RLIM_INFINITY};
  ASSERT_EQ(::prlimit(run.pid(), RLIMIT_FSIZE, &more, nullptr), 0);
  ASSERT_TRUE(becomes([&] { return has_event(folder, "record-resumed"); }));
  EXPECT_EQ(status(folder)["result"]["record"]["failure"], "");
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  run.kill(SIGTERM);
  EXPECT_EQ(run.wait().exit, 0);
  const RtRan replayed = replay(folder, {folder.folder.string()});
  EXPECT_EQ(replayed.exit, 0) << replayed.err;
  auto said = replayed.json()["result"];
  EXPECT_GE(said["files"], 2);
  EXPECT_EQ(said["beginnings"], 2) << "the start, and where it went on";
  EXPECT_GT(said["cycles"], 200);
}

/// Targets for a record of some MB, and what a replay says of it.
class RotatedRecord : public testing::Test {
 protected:
  RotatedRecord() {
    std::string targets = folder.text("targets.csv");
    const std::string rows = targets.substr(targets.find('\n') + 1);
    for (int i = 0; i < 120; ++i) targets += rows;
    folder.write("targets.csv", targets);
    const RtRan ran = plumb_rt({"run", folder.folder.string(), "--json"}, folder.folder);
    EXPECT_EQ(ran.exit, 0) << ran.err;
    EXPECT_EQ(ran.json()["result"]["record"]["failure"], "");
    for (const auto& entry : std::filesystem::directory_iterator(folder.folder))
      if (entry.path().filename().string().starts_with("record.log"))
        files.push_back(entry.path().filename().string());
    std::sort(files.begin(), files.end(), [](const std::string& a, const std::string& b) {
      return std::pair(a.size(), a) < std::pair(b.size(), b);  // .9 before .10
    });
  }
  nlohmann::json replayed(const std::vector<std::string>& words, int exit) {
    const RtRan ran = replay(folder, words);
    EXPECT_EQ(ran.exit, exit) << ran.err;
    return ran.json()["result"];
  }
  std::string path(const std::string& name) const { return (folder.folder / name).string(); }

  const Deployed folder{
      Deployed::csv("[log]\nrecord = \"record.log\"\n[record]\nmax_total_mb = 1\n")};
  std::vector<std::string> files;
};

TEST_F(RotatedRecord, ReplaysToTheBitThoughItsBeginningIsGone) {
  ASSERT_EQ(files.size(), 4U) << "the oldest were removed";
  EXPECT_EQ(std::count(files.begin(), files.end(), "record.log"), 0);
  std::uintmax_t total = 0;
  for (const auto& name : files) total += std::filesystem::file_size(folder.folder / name);
  EXPECT_LE(total, 1'000'000U);
  const auto all = replayed({folder.folder.string()}, 0);
  EXPECT_EQ(all["files"], 4);
  EXPECT_EQ(all["beginnings"], 1) << "without a gap between the files";
  EXPECT_EQ(all["unchecked"], 0);
  EXPECT_GT(all["cycles"], 1000);
  const auto last = replayed({path(files.back())}, 0);
  EXPECT_LT(last["cycles"], all["cycles"]);
  const auto two = replayed({path(files[1]), path(files[3])}, 0);
  EXPECT_EQ(two["beginnings"], 2) << "one is missing between them";
}

TEST_F(RotatedRecord, WhatIsDamagedIsFoundAndWhatIsTornIsPassedOver) {
  const std::string& name = files[1];
  const std::string record = folder.text(name);
  // Killed while it wrote: cut off anywhere, the record is readable up to its last whole line.
  std::uint64_t state = 1;
  for (int i = 0; i < 6; ++i) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    const std::size_t at = 60'000 + (state >> 33) % (record.size() - 60'000);
    folder.write(name, record.substr(0, at));
    const auto said = replayed({path(name)}, 0);
    EXPECT_EQ(said["torn"], record[at - 1] == '\n' ? 0 : 1);
    EXPECT_EQ(said["different"], 0);
    EXPECT_GT(said["cycles"], 0);
  }
  // An answer that is missing is a difference, and so is one digit.
  const std::size_t within = record.rfind('\n', record.rfind(" csv 130##", record.size() / 2)) + 1;
  folder.write(name, std::string(record).erase(within, record.find('\n', within) + 1 - within));
  EXPECT_GT(replayed({path(name)}, 1)["different"], 0);
  std::string other = record;
  char& digit = other[other.find(" csv 130##1", record.size() / 2) + 15];
  digit = digit == '0' ? '1' : '0';
  folder.write(name, other);
  EXPECT_GT(replayed({path(name)}, 1)["different"], 0);
  // A copy of the session of which a digit is wrong is not used.
  other = record;
  char& copied = other[other.find(" state 003##1") + 20];
  copied = copied == '0' ? '1' : '0';
  folder.write(name, other);
  EXPECT_EQ(replayed({path(name)}, 1)["unreadable"], 1);
  // A gap: cycles that cannot be compared, until a file that begins anew.
  other = record;
  const std::size_t middle = record.find("\n", record.size() / 2) + 1;
  other.insert(middle, "(0000000001.000000) gap 000#0100000000000000\n");
  folder.write(name, other);
  const auto gap = replayed({path(name), path(files[2])}, 1);
  EXPECT_GT(gap["unchecked"], 0);
  EXPECT_EQ(gap["different"], 0);
  EXPECT_EQ(gap["beginnings"], 2);
}

TEST(Run, MetricsAreForPrometheusAndHostilePeersDoNotHoldItUp) {
  const int port =
      20'000 + static_cast<int>(::getpid() % 6'000);  // below those that clients are given
  const Deployed folder(Deployed::csv("[log]\nmetrics_port = " + std::to_string(port) + "\n"));
  write_long_targets(folder);
  RtProgram run({"run", folder.folder.string(), "--json"}, folder.folder);
  ASSERT_TRUE(becomes([&] { return is_active(folder); }));
  const auto ask = [&](const std::string& request) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const int fd = ::socket(AF_INET, SOCK_STREAM, 0);
    if (::connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0)
      return std::string();
    std::ignore = ::send(fd, request.data(), request.size(), MSG_NOSIGNAL);
    std::string out;
    char block[4096];
    for (ssize_t got; (got = ::recv(fd, block, sizeof(block), 0)) > 0;)
      out.append(block, static_cast<std::size_t>(got));
    ::close(fd);
    return out;
  };
  const std::string page = ask("GET /metrics HTTP/1.1\r\nHost: x\r\n\r\n");
  EXPECT_EQ(page.rfind("HTTP/1.0 200 OK\r\n", 0), 0U) << page;
  EXPECT_NE(page.find("\nplumb_state 3\n"), std::string::npos) << page;
  EXPECT_NE(page.find("\n# TYPE plumb_answered_total counter\n"), std::string::npos);
  EXPECT_EQ(ask("GET / HTTP/1.1\r\n\r\n").rfind("HTTP/1.0 404", 0), 0U);
  EXPECT_EQ(ask("GET /metr"), "") << "a request that does not end";
  EXPECT_EQ(ask(std::string(100'000, 'A')), "") << "one that is too long";
  EXPECT_NE(ask("GET /metrics HTTP/1.1\r\n\r\n"), "") << "and the next is served";
  EXPECT_TRUE(becomes([&] { return is_active(folder); }));
  run.kill(SIGTERM);
  EXPECT_EQ(run.wait().exit, 0);
}

TEST(Run, TellsTheServiceManagerThatItBeats) {
  const Deployed folder;
  write_long_targets(folder);
  const std::string path = (folder.folder / "notify").string();
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path.copy(address.sun_path, path.size());
  const int fd = ::socket(AF_UNIX, SOCK_DGRAM, 0);
  ASSERT_EQ(::bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  RtProgram run({"run", folder.folder.string()}, folder.folder, [&] {
    ::setenv("NOTIFY_SOCKET", path.c_str(), 1);
    ::setenv("WATCHDOG_USEC", "200000", 1);
  });
  const auto told = [&] {
    char text[256];
    const ssize_t size = ::recv(fd, text, sizeof(text), 0);
    return std::string(text, static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
  };
  EXPECT_EQ(told(), "READY=1");
  for (int i = 0; i < 5; ++i) EXPECT_EQ(told().rfind("WATCHDOG=1\nSTATUS=", 0), 0U);
  run.kill(SIGTERM);
  EXPECT_EQ(run.wait().exit, 0);
  ::close(fd);
}

}  // namespace
}  // namespace plumb::tests
