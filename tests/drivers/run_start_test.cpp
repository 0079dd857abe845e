// SPDX-License-Identifier: Apache-2.0
// What one run leaves for the next, with a controller made of sockets; and what cannot hold a run
// up.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "rt/check.hpp"
#include "rt/last_run.hpp"
#include "tests/drivers/deployed.hpp"
#include "tests/drivers/raw_controller.hpp"
#include "tests/drivers/rt_program.hpp"

namespace plumb::tests {
namespace {

using enum drivers::SessionState;
using Json = nlohmann::json;
using namespace std::chrono_literals;

class ARunAfterAnother : public testing::Test {
 protected:
  static std::string toml(int port) {
    return Deployed::modbus_server(port) +
           "[limits]\nmode = \"full\"\n[log]\nrecord = \"record.log\"\n";
  }

  void start() {
    run = std::make_unique<RtProgram>(std::vector<std::string>{"run", folder.folder.string()},
                                      folder.folder);
  }
  /// Ends the run, and waits until the controller has seen that.
  void end(int signal) {
    run->kill(signal);
    const int exit = run->wait().exit;
    EXPECT_EQ(exit, signal == SIGKILL ? -1 : 0);
    run.reset();
    EXPECT_TRUE(becomes([&] { return controller.state == -1; }));
  }
  bool comes(drivers::SessionState state) {
    return becomes([&] { return controller.sees(state); });
  }
  Json status() const {
    return plumb_rt({"status", folder.folder.string(), "--json"}, folder.folder).json()["result"];
  }
  /// Stays in SHADOW for longer than the inputs must be good, and says why.
  void expect_to_wait(const std::string& why) {
    ASSERT_TRUE(comes(kShadow));
    std::this_thread::sleep_for(800ms);
    EXPECT_TRUE(controller.sees(kShadow));
    Json said = status();
    EXPECT_EQ(said["lost"], Json({"acknowledge"}));
    EXPECT_NE(said["acknowledge"].get<std::string>().find(why), std::string::npos)
        << said["acknowledge"];
  }

  /// One of the fault, which the journal names, and which replays by itself.
  void expect_a_snapshot() const {
    std::vector<Json> made;
    Json events =
        plumb_rt({"events", folder.folder.string(), "--json"}, folder.folder).json()["result"];
    for (const Json& event : events["events"])
      if (event["event"] == "snapshot" && event["reason"].get<std::string>().starts_with("fault"))
        made.push_back(event);
    ASSERT_EQ(made.size(), 1U) << events;
    EXPECT_EQ(made.front()["reason"], "fault-pose-mismatch");
    const std::string file = made.front()["file"];
    EXPECT_EQ(std::filesystem::path(file).parent_path(), folder.folder / "snapshots");
    const RtRan replayed =
        plumb_rt({"replay", file, "--dir", folder.folder.string(), "--json"}, folder.folder);
    EXPECT_EQ(replayed.exit, 0) << replayed.err;
    EXPECT_EQ(replayed.json()["result"]["state"], "fault") << replayed.out;
    EXPECT_GT(replayed.json()["result"]["answered"], 0) << "and before it the correction";
    EXPECT_GT(replayed.json()["result"]["cycles"], 100) << "the seconds before and after";
  }

  // Below the ports that clients are given: one that asks for such a port before anybody listens
  // there may be given that very one, and is then connected to itself.
  const int port = 26'000 + static_cast<int>(::getpid() % 6'000);
  Deployed folder{toml(port)};
  RawController controller{static_cast<std::uint16_t>(port), Deployed::arm().nominal,
                           drivers::fingerprint(Deployed::arm().serial)};
  std::unique_ptr<RtProgram> run;
};

TEST_F(ARunAfterAnother, AsksForAnAcknowledgementAfterACrashAndForANewModel) {
  start();
  expect_to_wait("first run");
  controller.press();
  ASSERT_TRUE(comes(kActive));
  EXPECT_EQ(status()["acknowledge"], "");
  end(SIGTERM);
  start();
  EXPECT_TRUE(comes(kActive)) << "it ended well, and its model was acknowledged";
  end(SIGKILL);
  start();
  expect_to_wait("did not end well");
  end(SIGTERM);
  start();
  expect_to_wait("was not acknowledged");
  controller.press();
  ASSERT_TRUE(comes(kActive));
  end(SIGTERM);
  format::Model other = Deployed::arm();
  for (auto& joint : other.calibrated.joints) joint.a -= 1e-4;
  folder.write_model("robot.plumb", other);
  start();
  expect_to_wait("first run with this model");
  end(SIGTERM);
}

TEST_F(ARunAfterAnother, OfAFolderThatIsNotThereNoEventsAreReported) {
  const RtRan ran = plumb_rt({"events", (folder.folder / "gone").string()}, folder.folder);
  EXPECT_EQ(ran.exit, 3);
  EXPECT_NE(ran.err.find("there is no folder"), std::string::npos) << ran.err;
}

TEST_F(ARunAfterAnother, BeginsInTheFaultThatNobodyAcknowledged) {
  start();
  ASSERT_TRUE(comes(kShadow));
  controller.press();
  ASSERT_TRUE(comes(kActive));
  controller.another_tool = true;
  ASSERT_TRUE(comes(kFault));
  controller.another_tool = false;
  std::this_thread::sleep_for(200ms);  // until it is written down
  for (const int signal : {SIGKILL, SIGTERM}) {
    end(signal);
    start();
    ASSERT_TRUE(comes(kFault));
    std::this_thread::sleep_for(700ms);
    EXPECT_TRUE(controller.sees(kFault));
    EXPECT_EQ(status()["fault"], "pose-mismatch");
  }
  controller.press();
  EXPECT_TRUE(comes(kActive));
  end(SIGTERM);
  const RtRan all = plumb_rt({"replay", folder.folder.string(), "--json"}, folder.folder);
  EXPECT_EQ(all.exit, 0) << all.err;
  EXPECT_EQ(all.json()["result"]["files"], 3);
  EXPECT_EQ(all.json()["result"]["beginnings"], 3) << "three runs";
  expect_a_snapshot();
  for (const char* const record : {"record.log", "record.log.1", "record.log.2"}) {
    const RtRan replayed = plumb_rt(
        {"replay", (folder.folder / record).string(), "--dir", folder.folder.string(), "--json"},
        folder.folder);
    EXPECT_EQ(replayed.exit, 0) << record << ": " << replayed.err;
    EXPECT_GT(replayed.json()["result"]["frames"], 20) << record;
  }
}

TEST_F(ARunAfterAnother, TakesADamagedNoteOfItForTheWorst) {
  folder.write("plumb-rt.state", "{\"schema\": \"plumb-rt-last-run/1\", \"ended\": tr");
  start();
  expect_to_wait("damaged");
  end(SIGTERM);
  std::filesystem::remove(folder.folder / "plumb-rt.state");
  ASSERT_EQ(::mkfifo((folder.folder / "plumb-rt.state").c_str(), 0600), 0);
  start();
  expect_to_wait("not known");
  end(SIGTERM);
}

/// A pipe that holds no more.
class FullPipe {
 public:
  FullPipe() {
    EXPECT_EQ(::pipe2(ends_, O_NONBLOCK), 0);
    while (::write(ends_[1], "x", 1) == 1) {
    }
    ::fcntl(ends_[1], F_SETFL, 0);
  }
  ~FullPipe() {
    for (const int end : ends_) ::close(end);
  }
  void become_stderr() const { ::dup2(ends_[1], STDERR_FILENO); }

 private:
  int ends_[2] = {-1, -1};
};

/// -2: it does not end, and was killed.
int exit_soon(RtProgram& program) {
  siginfo_t ended{};
  const auto over = [&] {
    return ::waitid(P_PID, static_cast<id_t>(program.pid()), &ended, WEXITED | WNOHANG | WNOWAIT) ==
               0 &&
           ended.si_pid != 0;
  };
  if (becomes(over)) return program.wait().exit;
  program.kill(SIGKILL);
  program.wait();
  return -2;
}

TEST_F(ARunAfterAnother, EndsAtOnceAndIsRefusedThoughNobodyReadsItsWords) {
  const FullPipe pipe;
  const auto started = [&] {
    return std::make_unique<RtProgram>(std::vector<std::string>{"run", folder.folder.string()},
                                       folder.folder, [&] { pipe.become_stderr(); });
  };
  run = started();
  ASSERT_TRUE(comes(kShadow));
  run->kill(SIGSTOP);  // it hears both before it can have ended
  run->kill(SIGINT);
  run->kill(SIGTERM);
  run->kill(SIGCONT);
  EXPECT_EQ(exit_soon(*run), 130);
  folder.write("rt.toml", "schema = \"rt/1\"\nunknown = 1\n");
  run = started();
  EXPECT_EQ(exit_soon(*run), 3);
}

/// The file is not signed, and a folder may have come from anywhere.
TEST_F(ARunAfterAnother, DoesNotBelieveWhatOthersMayHaveWritten) {
  start();
  ASSERT_TRUE(comes(kShadow));
  controller.press();
  ASSERT_TRUE(comes(kActive));
  end(SIGTERM);
  const auto note = folder.folder / "plumb-rt.state";
  const std::string acknowledged = folder.text("plumb-rt.state");
  const auto again = [&](const char* why) {
    start();
    expect_to_wait(why);
    end(SIGTERM);
    EXPECT_EQ(std::filesystem::status(note).permissions() & std::filesystem::perms::group_write,
              std::filesystem::perms::none);
    std::ofstream(note) << acknowledged;
  };
  std::filesystem::permissions(note, std::filesystem::perms::all);
  again("may be written by others");
  if (::geteuid() == 0) {
    ASSERT_EQ(::chown(note.c_str(), 65534, 65534), 0);
    again("belongs to user 65534");
  }
  start();
  EXPECT_TRUE(comes(kActive)) << "its own is believed";
  end(SIGTERM);
  const auto came = folder.folder.string() + "-copy";
  std::filesystem::copy(folder.folder, came, std::filesystem::copy_options::recursive);
  std::filesystem::rename(folder.folder, came + "-before");
  std::filesystem::rename(came, folder.folder);
  start();
  expect_to_wait("came here as a copy");
  end(SIGTERM);
  std::filesystem::permissions(folder.folder, std::filesystem::perms::others_write,
                               std::filesystem::perm_options::add);
  start();
  expect_to_wait("stands in a folder that may be written by others");
  end(SIGTERM);
  std::filesystem::remove_all(came + "-before");
}

/// A shell completes a name with a slash.
TEST(WhatTheLastRunLeft, IsNotBelievedInACopyHoweverTheFolderIsNamed) {
  const Deployed place("");
  std::ofstream(place.folder / "plumb-rt.state") << Json{{"schema", "plumb-rt-last-run/1"},
                                                         {"folder", ""},
                                                         {"ended", true},
                                                         {"fault", "none"},
                                                         {"acknowledged", "m"}};
  for (const auto& name : {place.folder, place.folder / ""})
    EXPECT_NE(drivers::rt::LastRun(name, "m").why().find("came here as a copy"), std::string::npos)
        << name << ": " << drivers::rt::LastRun(name, "m").why();
}

/// A stall, as of a debugger: it goes on without a correction, and begins anew.
TEST_F(ARunAfterAnother, AStoppedRunGoesOnWithoutCorrectionAndIsNoSecondSenderToItself) {
  start();
  ASSERT_TRUE(comes(kShadow));
  controller.press();
  ASSERT_TRUE(comes(kActive));
  for (const auto stop : {400ms, 700ms}) {
    run->kill(SIGSTOP);
    std::this_thread::sleep_for(stop);  // the controller gives up its connection after 200 ms
    run->kill(SIGCONT);
    EXPECT_TRUE(becomes([&] { return controller.state >= 0 && !controller.sees(kActive); }));
    EXPECT_FALSE(controller.sees(kFault));
    EXPECT_TRUE(comes(kActive));
  }
  Json said = status();
  EXPECT_EQ(said["counters"]["faults"], 0);
  EXPECT_EQ(said["link"]["foreign_senders"], 0);
  EXPECT_GE(said["counters"]["stalls"], 2);
  end(SIGTERM);
}

/// A controller that writes into plumb-rt, and packs its registers otherwise.
TEST(RunPacking, OfAControllerThatWritesIsToldByItsCheckSums) {
  const std::pair<RawArm::Packing, const char*> packings[] = {
      {{.words = true}, "word_order = \"little\" into [bus]"},
      {{.bytes = true}, "with the two bytes of each register swapped"},
      {{.shift = 1, .sum_before = true}, "with every register one further on"},
      {{.shift = -1}, "with every register one further back"}};
  const int port = 26'000 + static_cast<int>(::getpid() % 6'000);
  for (const auto& [packing, says] : packings) {
    const Deployed folder(Deployed::modbus_server(port));
    const RawController controller(static_cast<std::uint16_t>(port), Deployed::arm().nominal,
                                   drivers::fingerprint(Deployed::arm().serial), packing);
    RtProgram run({"run", folder.folder.string()}, folder.folder);
    Json link;
    EXPECT_TRUE(becomes([&] {
      Json said = plumb_rt({"status", folder.folder.string(), "--json"}, folder.folder).json();
      link = said.is_object() && said["result"].is_object() ? said["result"]["link"] : Json();
      return link.is_object() && link["packing"] != "";
    }));
    ASSERT_TRUE(link.is_object());
    EXPECT_NE(link["packing"].get<std::string>().find(says), std::string::npos) << link["packing"];
    const std::string event = "\"event\":\"packing\"";
    std::string journal;  // written a little after the status
    EXPECT_TRUE(becomes([&] {
      journal = folder.text("events.jsonl");
      return journal.find(event) != std::string::npos;
    }));
    EXPECT_EQ(journal.find(event), journal.rfind(event)) << "it is said once";
    run.kill(SIGTERM);
    EXPECT_EQ(run.wait().exit, 0);
  }
}

TEST(RunPacking, IsToldByDoctorOfAPlaceThatRuns) {
  const int port = 26'000 + static_cast<int>(::getpid() % 6'000);
  const Deployed folder(Deployed::modbus_server(port));
  const auto store = std::filesystem::path(folder.folder.string() + "-store");
  std::filesystem::create_directory(store);
  const std::string place = (store / "cell4").string();
  const RtRan ran = plumb_rt({"install", folder.folder.string(), "--to", place}, store);
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_TRUE(drivers::rt::packing_checks(store).empty()) << "nobody runs it";
  const RawController controller(static_cast<std::uint16_t>(port), Deployed::arm().nominal,
                                 drivers::fingerprint(Deployed::arm().serial), {.bytes = true});
  RtProgram run({"run", place}, store);
  std::vector<drivers::rt::Check> told;
  EXPECT_TRUE(becomes([&] { return !(told = drivers::rt::packing_checks(store)).empty(); }));
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].finding.grant, drivers::Grant::kDenied);
  EXPECT_EQ(told[0].finding.why.rfind("cell4: the check sums", 0), 0U) << told[0].finding.why;
  run.kill(SIGTERM);
  EXPECT_EQ(run.wait().exit, 0);
  std::filesystem::remove_all(store);
}

TEST(RunModel, WhatIsNoRegularFileIsRefusedAndHoldsNothingUp) {
  const Deployed folder;
  const std::string first = folder.text("targets.csv");
  const std::string row =
      first.substr(first.find('\n') + 1, first.find('\n', first.find('\n') + 1) - first.find('\n'));
  std::string rows;
  for (int i = 0; i < 20'000; ++i) rows += row;
  folder.write("targets.csv", first + rows);
  const auto file = [&](const char* name) { return (folder.folder / name).string(); };
  ASSERT_EQ(::mkfifo(file("pipe.model").c_str(), 0600), 0);
  folder.write("large.model", "");
  std::filesystem::resize_file(file("large.model"), 1u << 30);  // one with holes

  RtProgram run({"run", folder.folder.string(), "--json"}, folder.folder);
  const auto ask = [&](std::vector<std::string> words) { return plumb_rt(words, folder.folder); };
  const auto runs = [&] { return ask({"status", folder.folder.string()}).exit == 0; };
  ASSERT_TRUE(becomes(runs));
  const std::pair<std::string, const char*> bad[] = {{file("pipe.model"), "no regular file"},
                                                     {"/dev/zero", "no regular file"},
                                                     {file("large.model"), "more than 16 MB"}};
  for (const auto& [model, why] : bad) {
    const auto begin = std::chrono::steady_clock::now();
    const RtRan ran = ask({"swap", model, "--dir", folder.folder.string()});
    EXPECT_EQ(ran.exit, 3) << model;
    EXPECT_NE(ran.err.find(why), std::string::npos) << ran.err;
    EXPECT_LT(std::chrono::steady_clock::now() - begin, 4s) << model;
    EXPECT_TRUE(runs());
  }
  const auto begin = std::chrono::steady_clock::now();
  run.kill(SIGTERM);
  EXPECT_EQ(run.wait().exit, 0);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 3s);

  std::filesystem::remove(file("robot.plumb"));
  ASSERT_EQ(::mkfifo(file("robot.plumb").c_str(), 0600), 0);
  EXPECT_EQ(ask({"run", folder.folder.string()}).exit, 3) << "nor is it waited for at the start";
}

}  // namespace
}  // namespace plumb::tests
