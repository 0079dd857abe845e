// SPDX-License-Identifier: Apache-2.0
// Whose the registers of a controller are: plumb-rt as client of a controller made of sockets,
// beside a second plumb-rt, beside another client, and with a controller that starts again.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "tests/drivers/deployed.hpp"
#include "tests/drivers/raw_server.hpp"
#include "tests/drivers/rt_program.hpp"

namespace plumb::tests {
namespace {

using enum drivers::SessionState;
using Json = nlohmann::json;
using namespace std::chrono_literals;

constexpr const char* kWithOwner = "[bus]\nowner_register = 1288\n";
constexpr const char* kWithoutOwner = "";  // as a folder of before

/// plumb-rt as client of that controller, from a folder of its own.
class ClientOf {
 public:
  ClientOf(const RawServer& server, const std::string& bus)
      : folder(
            "schema = \"rt/1\"\n[cycle]\npriority = 0\n[source]\nkind = \"modbus\"\n"
            "role = \"client\"\nport = " +
            std::to_string(server.port) + "\n[limits]\nmode = \"full\"\n" + bus) {
    start();
  }
  void start(const std::function<void()>& before = [] {}) {
    run = std::make_unique<RtProgram>(std::vector<std::string>{"run", folder.folder.string()},
                                      folder.folder, before);
  }
  void end() {
    run->kill(SIGTERM);
    EXPECT_EQ(run->wait().exit, 0);
    run.reset();
  }
  /// Not const where it is read: a key that a const one lacks is undefined behaviour, of one that
  /// is not const it is null. A status that did not come in time lacks most of them.
  Json status() const {
    Json said = plumb_rt({"status", folder.folder.string(), "--json"}, folder.folder).json();
    return said.is_object() && said.contains("result") && said["result"].is_object()
               ? said["result"]
               : Json{{"state", "none"}, {"fault", ""}};
  }
  bool becomes_foreign() const {
    return becomes([&] {
      Json said = status();
      return said["state"] == "fault" && said["fault"] == "foreign-sender";
    });
  }
  /// What the journal says of a kind of event.
  int events(const std::string& kind) const {
    const std::string text = folder.text("events.jsonl");
    int out = 0;
    for (std::size_t at = 0; (at = text.find("\"event\":\"" + kind + "\"", at)) != text.npos; ++at)
      ++out;
    return out;
  }

  Deployed folder;
  std::unique_ptr<RtProgram> run;
};

class RegistersOfOne : public testing::Test {
 protected:
  bool comes(drivers::SessionState state) {
    return becomes([&] { return server.sees(state); });
  }
  void activate() {
    ASSERT_TRUE(comes(kShadow));
    EXPECT_TRUE(becomes([&] { return server.asks() || server.sees(kActive); }));
    server.press();
    ASSERT_TRUE(comes(kActive));
    ASSERT_TRUE(
        becomes([&] { return server.largest_correction_m(server.newest_client()) > 1e-4; }));
  }
  void expect_no_step() {
    EXPECT_LE(server.largest_speed_m_s(), 1.0001 * Deployed::arm().guard.slew_m_per_s);
  }
  int writes_by(int client) {
    const auto writes = server.writes();
    return static_cast<int>(std::ranges::count(writes, client, &RawServer::Write::client));
  }
  void expect_one_alone_in_them(const ClientOf& first, const ClientOf& second) {
    ASSERT_TRUE(becomes([&] {
      return first.status()["fault"] == "foreign-sender" ||
             second.status()["fault"] == "foreign-sender";
    }));
    std::this_thread::sleep_for(300ms);
    server.forget_writes();
    std::this_thread::sleep_for(300ms);
    EXPECT_GT(writes_by(1) + writes_by(2), 5);
    EXPECT_EQ(std::min(writes_by(1), writes_by(2)), 0) << "one alone has the token";
  }
  std::uint32_t token() {
    const auto words = server.registers(RawServer::kOwner, 2);
    return std::uint32_t{words[0]} << 16 | words[1];
  }

  RawServer server{Deployed::arm().nominal, drivers::fingerprint(Deployed::arm().serial)};
};

TEST_F(RegistersOfOne, ASecondPlumbThatComesLaterWritesNothingAndTheFirstGoesOn) {
  for (const char* const bus : {kWithOwner, kWithoutOwner}) {
    RawServer another{Deployed::arm().nominal, drivers::fingerprint(Deployed::arm().serial)};
    ClientOf first(another, bus);
    ASSERT_TRUE(becomes([&] { return another.sees(kShadow); }));
    const int before = another.newest_client();
    ClientOf second(another, bus);
    EXPECT_TRUE(second.becomes_foreign());
    std::this_thread::sleep_for(400ms);  // longer than registers that rest are watched
    EXPECT_GT(another.newest_client(), before) << "it connected";
    for (const auto& write : another.writes()) ASSERT_LE(write.client, before);
    EXPECT_TRUE(another.sees(kShadow));
    EXPECT_EQ(first.status()["link"]["foreign_senders"], 0);
    EXPECT_TRUE(becomes([&] { return second.events("fault") >= 1; }));
    first.end();
    EXPECT_TRUE(becomes([&] { return another.sees(kFault); }))
        << "once the first is gone, the second has the registers, and says its fault in them";
    second.end();
  }
}

/// What plumb-rt says of writes that the controller refuses: the input that is lost, the exception
/// and the registers.
void expect_refused(const ClientOf& plumb, int exception, const std::string& registers) {
  EXPECT_TRUE(becomes([&] {
    Json said = plumb.status();
    return said["state"] != "active" &&
           said["lost"].dump().find("\"answers\"") != std::string::npos;
  })) << plumb.status()["lost"];
  Json link = plumb.status()["link"];
  EXPECT_EQ(link["refusal"].get<std::string>().rfind(
                "registers " + registers + ": exception " + std::to_string(exception), 0),
            0U)
      << link;
  EXPECT_GT(link["refused_writes"], 3);
  EXPECT_TRUE(becomes([&] {
    return plumb.folder.text("events.jsonl").find("\"refused\":\"registers " + registers) !=
           std::string::npos;
  })) << "the journal is written a little after the status";
}

TEST_F(RegistersOfOne, WritesThatAreRefusedAreALostInputUntilOneIsTaken) {
  ClientOf plumb(server, kWithOwner);
  ASSERT_NO_FATAL_FAILURE(activate());
  for (const int exception : {2, 3, 4}) {
    server.refuse(static_cast<std::uint8_t>(exception));
    expect_refused(plumb, exception, "1200 to 1214");
    server.refuse(0);
    EXPECT_TRUE(becomes([&] { return plumb.status()["state"] == "active"; }));
    EXPECT_EQ(plumb.status()["link"]["refusal"], "");
  }
  expect_no_step();
  plumb.end();
}

TEST_F(RegistersOfOne, AnAnswerAloneThatIsRefusedIsALostInput) {
  ClientOf plumb(server, kWithOwner);
  ASSERT_NO_FATAL_FAILURE(activate());
  server.refuse(2, RawServer::kCorrected, RawServer::kStatus);
  expect_refused(plumb, 2, "1200 to 1214");
  EXPECT_TRUE(comes(kHold)) << "the status still arrives";
  EXPECT_TRUE(becomes([&] { return plumb.status()["correction"]["applied_um"] == 0.0; }));
  EXPECT_EQ(plumb.status()["link"]["state"], "degraded");
  plumb.end();
}

TEST_F(RegistersOfOne, WritesThatWereNeverTakenAreALostInput) {
  server.refuse(1);
  ClientOf plumb(server, kWithoutOwner);
  expect_refused(plumb, 1, "1248 to 1264");
  plumb.end();
}

TEST_F(RegistersOfOne, AControllerThatIsBusyForAMomentLosesNothing) {
  ClientOf plumb(server, kWithOwner);
  ASSERT_NO_FATAL_FAILURE(activate());
  for (int i = 0; i < 10; ++i) {
    server.refuse(6);
    std::this_thread::sleep_for(8ms);
    server.refuse(0);
    std::this_thread::sleep_for(100ms);
  }
  Json said = plumb.status();
  EXPECT_EQ(said["state"], "active");
  EXPECT_EQ(said["counters"]["holds"], 0);
  EXPECT_EQ(said["link"]["packing"], "");
  EXPECT_GT(said["link"]["refused_writes"], 0);
  plumb.end();
}

/// What is said of the check sums of a controller that packs its registers so.
struct PackedOtherwise {
  RawArm::Packing packing;
  const char* says;
  const char* remedy;
  bool strict = false;
};
constexpr const char* kSwapped = "with the two registers of each number swapped: ";
constexpr const char* kFurther = "with every register one further on, ";
constexpr const char* kNoKey = "no key of rt.toml";
const PackedOtherwise kPackings[] = {
    {{.words = true}, kSwapped, "word_order = \"little\" into [bus]"},
    {{.words = true, .sum_before = true}, kSwapped, kNoKey},
    {{.bytes = true}, "with the two bytes of each register swapped: ", kNoKey},
    {{.words = true, .bytes = true, .sum_before = true},
     "number swapped and the two bytes",
     kNoKey},
    {{.shift = 1, .sum_before = true}, kFurther, kNoKey},
    {{.shift = 1}, kFurther, " into [bus."},
    {{.shift = -1, .sum_before = true}, "with every register one further back, ", kNoKey},
    {{.shift = 1, .sum_before = true}, kFurther, kNoKey, true},
};

TEST_F(RegistersOfOne, ThatAreSwappedOrShiftedAreToldByTheirCheckSumsAndNeverUsed) {
  for (const auto& [packing, says, remedy, strict] : kPackings) {
    SCOPED_TRACE(says);
    RawServer other{Deployed::arm().nominal, drivers::fingerprint(Deployed::arm().serial), packing,
                    strict};
    ClientOf plumb(other, kWithOwner);
    std::string said;
    EXPECT_TRUE(becomes([&] {
      Json now = plumb.status();
      said = now.contains("link") ? now["link"]["packing"].get<std::string>() : "";
      return !said.empty();
    }));
    EXPECT_NE(said.find(says), std::string::npos) << said;
    EXPECT_NE(said.find(remedy), std::string::npos) << said;
    std::this_thread::sleep_for(300ms);
    EXPECT_EQ(plumb.status()["state"], "init") << "it is told, and not switched";
    EXPECT_TRUE(becomes([&] { return plumb.events("packing") == 1; }));
    plumb.run->kill(SIGTERM);
    const RtRan ran = plumb.run->wait();
    EXPECT_EQ(ran.exit, 0);
    EXPECT_NE(ran.err.find(says), std::string::npos);
    EXPECT_NE(ran.out.find("registers   the check sums"), std::string::npos) << ran.out;
  }
}

TEST_F(RegistersOfOne, TheRemedyForSwappedRegistersIsOne) {
  RawServer other{
      Deployed::arm().nominal, drivers::fingerprint(Deployed::arm().serial), {.words = true}};
  ClientOf plumb(other, "[bus]\nowner_register = 1288\nword_order = \"little\"\n");
  EXPECT_TRUE(becomes([&] { return plumb.status()["state"] == "shadow"; }));
  EXPECT_EQ(plumb.status()["link"]["packing"], "");
  plumb.end();
}

/// The lowest number that no file of the process has.
int free_number(pid_t pid) {
  int out = 0;
  while (std::filesystem::exists(
      std::filesystem::symlink_status(fmt::format("/proc/{}/fd/{}", pid, out))))
    ++out;
  return out;
}

TEST_F(RegistersOfOne, WithoutADescriptorTheStatusAnswersAndSaysSo) {
  ClientOf plumb(server, kWithOwner);
  ASSERT_NO_FATAL_FAILURE(activate());
  rlimit before{};
  ASSERT_EQ(::prlimit(plumb.run->pid(), RLIMIT_NOFILE, nullptr, &before), 0);
  rlimit least = before;
  least.rlim_cur = static_cast<rlim_t>(free_number(plumb.run->pid()));
  ASSERT_EQ(::prlimit(plumb.run->pid(), RLIMIT_NOFILE, &least, nullptr), 0);
  for (int i = 0; i < 5; ++i) {
    Json said = plumb.status();
    ASSERT_NE(said["state"], "none");
    EXPECT_EQ(said["shortage"].get<std::string>().rfind("no file descriptor is left (limit", 0), 0U)
        << said["shortage"];
  }
  server.forget_writes();
  EXPECT_TRUE(becomes([&] { return server.writes().size() > 20; })) << "the correction goes on";
  ASSERT_EQ(::prlimit(plumb.run->pid(), RLIMIT_NOFILE, &before, nullptr), 0);
  EXPECT_EQ(plumb.status()["shortage"], "");
  plumb.end();
}

bool has_ended(const RtProgram& run) {
  siginfo_t info{};
  return ::waitid(P_PID, static_cast<id_t>(run.pid()), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         info.si_pid != 0;
}

TEST_F(RegistersOfOne, WhoReadsTheSummaryNoMoreHoldsNothingUpAndChangesNoExitCode) {
  int ends[2], closed[2];
  ASSERT_EQ(::pipe2(ends, O_CLOEXEC | O_NONBLOCK), 0);
  while (::write(ends[1], "x", 1) == 1) {
  }
  ::fcntl(ends[1], F_SETFL, 0);
  ASSERT_EQ(::pipe2(closed, O_CLOEXEC), 0);
  ::close(closed[0]);
  const std::function<void()> streams[] = {
      [&] { ::dup2(ends[1], STDOUT_FILENO); },
      [&] { ::dup2(ends[1], STDOUT_FILENO), ::dup2(ends[1], STDERR_FILENO); },
      [&] { ::dup2(closed[1], STDOUT_FILENO); },
      [&] { ::dup2(::open("/dev/full", O_WRONLY), STDOUT_FILENO); },
      [&] { ::close(STDOUT_FILENO), ::close(STDERR_FILENO), ::close(STDIN_FILENO); }};
  ClientOf plumb(server, kWithOwner);
  ASSERT_NO_FATAL_FAILURE(activate());
  plumb.end();
  for (std::size_t i = 0; i < std::size(streams); ++i) {
    SCOPED_TRACE(i);
    plumb.start(streams[i]);
    ASSERT_TRUE(comes(kActive)) << "the run before ended well";
    plumb.run->kill(SIGTERM);
    EXPECT_TRUE(becomes([&] { return has_ended(*plumb.run); }));
    plumb.run->kill(SIGKILL);
    EXPECT_EQ(plumb.run->wait().exit, 0);
    plumb.run.reset();
    server.zero();
  }
  for (const int end : {ends[0], ends[1], closed[1]}) ::close(end);
}

TEST_F(RegistersOfOne, WhoReadsStderrNoMoreHoldsNothingUp) {
  int ends[2];
  ASSERT_EQ(::pipe2(ends, O_CLOEXEC | O_NONBLOCK), 0);
  while (::write(ends[1], "x", 1) == 1) {
  }
  ::fcntl(ends[1], F_SETFL, 0);
  ClientOf plumb(server, kWithOwner);
  ASSERT_TRUE(comes(kShadow));
  plumb.end();
  server.zero();
  plumb.start([&] { ::dup2(ends[1], STDERR_FILENO); });
  ASSERT_NO_FATAL_FAILURE(activate());
  EXPECT_TRUE(becomes([&] { return plumb.status()["state"] == "active"; }));
  EXPECT_TRUE(becomes([&] { return plumb.events("start") >= 2; })) << "the journal goes on";
  plumb.end();
  ::close(ends[0]);
  ::close(ends[1]);
}

TEST_F(RegistersOfOne, TwoThatBeginAtOnceAreNotBothInThem) {
  ClientOf first(server, kWithOwner), second(server, kWithOwner);
  expect_one_alone_in_them(first, second);
}

/// Whoever went on without a token would write beside the other one.
TEST_F(RegistersOfOne, ATokenThatIsRefusedForTheMomentIsAskedForAgain) {
  server.refuse(4);
  ClientOf first(server, kWithOwner), second(server, kWithOwner);
  for (const ClientOf* const plumb : {&first, &second}) expect_refused(*plumb, 4, "1288 to 1289");
  server.refuse(0);
  expect_one_alone_in_them(first, second);
}

/// Without a place for a token the one that looks first finds what it did not write. As it then
/// writes nothing more, the other may see nothing.
TEST_F(RegistersOfOne, OfTwoThatBeginAtOnceWithoutATokenOneAtLeastIsInFault) {
  ClientOf first(server, kWithoutOwner), second(server, kWithoutOwner);
  EXPECT_TRUE(becomes([&] {
    return first.status()["fault"] == "foreign-sender" ||
           second.status()["fault"] == "foreign-sender";
  }));
}

TEST_F(RegistersOfOne, AnotherClientIsNoticedAtTheNextPoll) {
  for (const std::uint16_t first : {RawServer::kCorrected, RawServer::kStatus}) {
    RawServer another{Deployed::arm().nominal, drivers::fingerprint(Deployed::arm().serial)};
    ClientOf plumb(another, kWithOwner);
    ASSERT_TRUE(becomes([&] { return another.sees(kShadow); }));
    another.press();
    ASSERT_TRUE(becomes([&] { return another.largest_correction_m(1) > 1e-4; }));
    another.forget_writes();
    const int looks = another.looks_of(1);
    another.put(first, RawServer::Words{0, 7, 0, 8});
    EXPECT_TRUE(becomes([&] { return another.sees(kFault); }));
    // A look every 2 ms, twice if it finds something; the status is due within 20 ms.
    int until = 1000;
    for (const auto& write : another.writes())
      if (write.first == RawServer::kStatus && write.words[1] == static_cast<int>(kFault))
        until = std::min(until, write.looks - looks);
    std::printf("its status said so after %d looks\n", until);
    EXPECT_LE(until, 18);
    // The control socket answers with the state of some cycles before.
    EXPECT_TRUE(becomes([&] { return plumb.status()["fault"] == "foreign-sender"; }));
    EXPECT_LE(another.largest_speed_m_s(), 1.0001 * Deployed::arm().guard.slew_m_per_s);
    plumb.end();
  }
}

TEST_F(RegistersOfOne, AnotherTokenSilencesAnOwnerUntilItRests) {
  ClientOf plumb(server, kWithOwner);
  activate();
  const std::uint32_t own = token();
  EXPECT_NE(own, 0U);
  server.put(RawServer::kOwner, {0x1234, 0x5678});
  EXPECT_TRUE(plumb.becomes_foreign());
  EXPECT_TRUE(comes(kFault)) << "as nobody uses them, it takes the registers again";
  EXPECT_EQ(token(), own);
  expect_no_step();
}

/// What another one's token says is not undone by a new connection: where the controller lets both
/// wait, nothing changes meanwhile, and the one that watched would take what is not at rest.
TEST_F(RegistersOfOne, AWatchBeginsAnewWithANewConnection) {
  ClientOf plumb(server, kWithOwner);
  activate();
  server.put(RawServer::kOwner, {0x1234, 0x5678});
  EXPECT_TRUE(becomes([&] { return plumb.status()["fault"] == "foreign-sender"; }));
  server.put(RawServer::kOwner, {0x1234, 0x5679});
  std::this_thread::sleep_for(20ms);  // it looks every millisecond
  server.forget_writes();
  for (int i = 0; i < 10; ++i) {
    server.hang_up();
    std::this_thread::sleep_for(100ms);
  }
  EXPECT_EQ(server.writes().size(), 0U);
  EXPECT_TRUE(comes(kFault)) << "as nobody uses them, it takes the registers again";
}

/// Whether a client took registers into which nobody had written for a while, as it may: its first
/// write came that long after the last one of the others, or after `since`.
bool took_what_rested(RawServer& server, int client, std::chrono::steady_clock::time_point since) {
  constexpr auto kRest = 200ms;  // registers are watched for 300 ms before they are taken
  for (const auto& write : server.writes()) {
    if (write.client == client) return write.time - since > kRest;
    since = write.time;
  }
  return false;
}

/// "client 1 at 12 ms: 5 registers from 40", write by write.
std::string timeline(const std::vector<RawServer::Write>& writes,
                     std::chrono::steady_clock::time_point since) {
  std::string out;
  for (const auto& write : writes)
    out += fmt::format("client {} at {:.1f} ms: {} registers from {}\n", write.client,
                       std::chrono::duration<double, std::milli>(write.time - since).count(),
                       write.words.size(), write.first);
  return out;
}

/// The first client of a server is stopped until a second one has taken its registers. False where
/// a busy machine kept one of them from running, so that the second let them rest and the first
/// took them again, rightly: that says nothing.
bool a_stopped_client_writes_nothing() {
  RawServer server{Deployed::arm().nominal, drivers::fingerprint(Deployed::arm().serial)};
  const auto comes = [&](drivers::SessionState state) {
    return becomes([&] { return server.sees(state); });
  };
  const auto activated = [&] {
    const bool there = comes(kShadow);  // what rests may be taken
    server.press();
    return there && comes(kActive);
  };
  ClientOf first(server, kWithOwner);
  if (!activated() || !becomes([&] { return server.largest_correction_m(1) > 1e-4; })) return false;
  const int old = server.newest_client();
  first.run->kill(SIGSTOP);
  ClientOf second(server, kWithOwner);
  if (!activated()) return false;
  server.forget_writes();
  const auto continued = std::chrono::steady_clock::now();
  first.run->kill(SIGCONT);
  if (!first.becomes_foreign() || took_what_rested(server, old, continued)) return false;
  const auto writes = server.writes();
  EXPECT_EQ(std::ranges::count(writes, old, &RawServer::Write::client), 0)
      << timeline(writes, continued);
  EXPECT_TRUE(server.sees(kActive));
  EXPECT_LE(server.largest_speed_m_s(), 1.0001 * Deployed::arm().guard.slew_m_per_s);
  return true;
}

TEST(RegistersOfTwo, WhoWasStoppedFindsThatAnotherTookOver) {
  bool told = false;
  for (int attempt = 0; attempt < 5 && !told; ++attempt) told = a_stopped_client_writes_nothing();
  EXPECT_TRUE(told) << "one of them was kept from running in every attempt";
}

TEST_F(RegistersOfOne, AControllerThatStartsAgainIsNoSecondSender) {
  ClientOf plumb(server, kWithOwner);
  activate();
  const std::uint32_t own = token();
  std::size_t before = server.writes().size();
  server.zero();
  EXPECT_TRUE(becomes([&] { return server.has_seen(kHold, before); }))
      << "its correction begins anew";
  EXPECT_TRUE(comes(kActive));
  before = server.writes().size();
  server.zero();  // and takes the connection with it
  server.hang_up();
  EXPECT_TRUE(
      becomes([&] { return server.has_seen(kHold, before) || server.has_seen(kSync, before); }));
  EXPECT_TRUE(comes(kActive));
  Json said = plumb.status();
  EXPECT_GE(said["link"]["restarts"], 2);
  EXPECT_EQ(said["link"]["foreign_senders"], 0);
  EXPECT_EQ(said["counters"]["faults"], 0);
  EXPECT_EQ(token(), own);
  expect_no_step();
}

TEST_F(RegistersOfOne, AWriteWithoutAnAnswerIsNoSecondSender) {
  ClientOf plumb(server, kWithOwner);
  activate();
  for (const auto lost : {RawServer::Lose::kRequest, RawServer::Lose::kAnswer})
    for (int i = 0; i < 3; ++i) {
      const int before = server.newest_client();
      server.lose = lost;
      ASSERT_TRUE(becomes([&] { return server.newest_client() > before; }));
      std::this_thread::sleep_for(50ms);
    }
  server.hang_up();
  std::this_thread::sleep_for(100ms);
  Json said = plumb.status();
  EXPECT_EQ(said["link"]["foreign_senders"], 0);
  EXPECT_EQ(said["link"]["restarts"], 0);
  EXPECT_GE(said["link"]["reconnects"], 7);
  EXPECT_EQ(said["counters"]["faults"], 0);
}

/// What an earlier run left is watched for a while, and then taken.
TEST_F(RegistersOfOne, TheNextRunTakesThemOver) {
  ClientOf plumb(server, kWithOwner);
  activate();
  const std::uint32_t earlier = token();
  plumb.end();
  const int before = server.newest_client();
  plumb.start();
  ASSERT_TRUE(becomes([&] { return server.newest_client() > before && token() != earlier; }));
  EXPECT_TRUE(comes(kActive));
  EXPECT_EQ(plumb.status()["link"]["foreign_senders"], 0);
  const auto writes = server.writes();
  const auto first = std::ranges::find_if(
      writes, [before](const RawServer::Write& write) { return write.client > before; });
  ASSERT_NE(first, writes.end());
  EXPECT_EQ(first->first, RawServer::kOwner);
  EXPECT_GT(first->looks, 50) << "0.3 s of looks every 2 ms, on a machine that may be busy";
}

}  // namespace
}  // namespace plumb::tests
