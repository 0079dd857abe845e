// SPDX-License-Identifier: Apache-2.0
// The program plumb-rt as a user meets it: help, JSON, exit codes.
#include <fcntl.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "plumb/format/version.hpp"
#include "program/machine_code.hpp"
#include "tests/drivers/child.hpp"
#include "tests/drivers/fake_machine.hpp"

namespace plumb {
namespace {

using Json = nlohmann::json;
using tests::FakeMachine;

struct Ran {
  int exit = -1;
  std::string out, err;
  Json json() const { return Json::parse(out); }
};

void redirect(const std::string& file, int to) {
  const int fd = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (fd < 0 || ::dup2(fd, to) < 0) ::_exit(126);
}

std::string text_of(const std::string& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

Ran plumb_rt(std::vector<std::string> words) {
  const FakeMachine scratch;
  const std::string out = scratch.root() / "out", err = scratch.root() / "err";
  words.insert(words.begin(), PLUMB_RT_PROGRAM);
  Ran ran;
  ran.exit = tests::in_child([&] {
    redirect(out, STDOUT_FILENO);
    redirect(err, STDERR_FILENO);
    std::vector<char*> argv;
    for (auto& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    ::execv(argv.front(), argv.data());
    return 127;
  });
  ran.out = text_of(out);
  ran.err = text_of(err);
  return ran;
}

TEST(PlumbRt, HelpBeginsWithTwoExamplesThatRun) {
  for (const auto& words : {std::vector<std::string>{"--help"}, {"doctor", "--help"}}) {
    const Ran ran = plumb_rt(words);
    EXPECT_EQ(ran.exit, 0);
    EXPECT_EQ(ran.out.rfind("Examples:\n  plumb-rt doctor ", 0), 0U) << ran.out;
    EXPECT_LT(ran.out.find("\n  plumb-rt doctor --"), ran.out.find("Usage:"));
  }
  EXPECT_EQ(plumb_rt({"doctor"}).exit, 0);
  EXPECT_EQ(plumb_rt({"doctor", "--cycle-us", "1000"}).exit, 0);
}

TEST(PlumbRt, JsonIsOneObjectWithTheAgreedKeys) {
  const Ran ran = plumb_rt({"doctor", "--json"});
  EXPECT_EQ(ran.exit, 0);
  const Json json = ran.json();
  for (const char* key :
       {"schema", "ok", "command", "version", "inputs", "warnings", "result", "error"})
    EXPECT_TRUE(json.contains(key)) << key;
  EXPECT_EQ(json["schema"], "plumb-rt.doctor/1");
  EXPECT_EQ(json["command"], "doctor");
  EXPECT_EQ(json["version"], format::kVersion);
  EXPECT_EQ(json["ok"], true);
  EXPECT_TRUE(json["error"].is_null());
  EXPECT_EQ(json["result"]["cycle_us"], 4000);
  EXPECT_GE(json["result"]["checks"].size(), 14U);
  EXPECT_EQ(plumb_rt({"--json", "doctor"}).json()["command"], "doctor");
}

TEST(PlumbRt, StrictEndsWithFiveOnAnUnfitMachineOnly) {
  const FakeMachine machine;
  const std::string root = machine.root();
  EXPECT_EQ(plumb_rt({"doctor", "--root", root}).exit, 0);
  const Ran unfit = plumb_rt({"doctor", "--root", root, "--strict", "--json"});
  EXPECT_EQ(unfit.exit, 5);
  EXPECT_EQ(unfit.json()["ok"], false);
  EXPECT_EQ(unfit.json()["result"]["fit"], false);
  EXPECT_EQ(unfit.json()["error"]["code"], "E-UNFIT");
  EXPECT_EQ(unfit.json()["error"]["exit"], 5);
  const Ran here = plumb_rt({"doctor", "--strict", "--json"});
  EXPECT_EQ(here.exit, here.json()["result"]["fit"] == true ? 0 : 5);
}

TEST(PlumbRt, TriesNothingWhenItLooksAtACopy) {
  const FakeMachine machine;
  const Ran ran = plumb_rt({"doctor", "--root", machine.root()});
  EXPECT_NE(ran.out.find("priority was not tried"), std::string::npos) << ran.out;
  EXPECT_NE(ran.out.find("granted  kernel          6.1.0-56-rt-amd64 is PREEMPT_RT\n"),
            std::string::npos)
      << ran.out;
}

TEST(PlumbRt, UsageErrorsEndWithTwoAndSayWhy) {
  const std::vector<std::vector<std::string>> wrong = {{},
                                                       {"docter"},
                                                       {"run"},
                                                       {"--no-such"},
                                                       {"doctor", "--no-such"},
                                                       {"doctor", "extra"},
                                                       {"doctor", "--cycle-us"},
                                                       {"doctor", "--cycle-us", "0"},
                                                       {"doctor", "--cycle-us", "fast"}};
  for (auto words : wrong) {
    const Ran ran = plumb_rt(words);
    EXPECT_EQ(ran.exit, 2) << ran.out;
    EXPECT_NE(ran.err.find("error[E-USAGE"), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find("  = help: "), std::string::npos) << ran.err;
    EXPECT_EQ(ran.out, "");
    words.push_back("--json");
    const Ran json = plumb_rt(words);
    EXPECT_EQ(json.exit, 2);
    EXPECT_EQ(json.json()["error"]["code"].get<std::string>().rfind("E-USAGE", 0), 0U);
  }
}

TEST(PlumbRt, EndsWithFiveWhenThereIsNothingToLookAt) {
  const Ran ran = plumb_rt({"doctor", "--root", "/no/such/folder", "--json"});
  EXPECT_EQ(ran.exit, 5);
  EXPECT_EQ(ran.json()["error"]["code"], "E-ROOT");
}

TEST(PlumbRt, SaysItsVersionAndForWhichProcessorsItIsCompiled) {
  EXPECT_EQ(plumb_rt({"--version"}).out,
            std::string("plumb-rt ") + format::kVersion + " (" + machine_code() + ")\n");
}

TEST(PlumbRt, EndsWithFiveWhenItsOutputCannotBeWritten) {
  if (::access("/dev/full", W_OK) != 0) GTEST_SKIP() << "no /dev/full";
  EXPECT_EQ(5, tests::in_child([] {
              redirect("/dev/full", STDOUT_FILENO);
              redirect("/dev/null", STDERR_FILENO);
              ::execl(PLUMB_RT_PROGRAM, PLUMB_RT_PROGRAM, "doctor", nullptr);
              return 127;
            }));
}

}  // namespace
}  // namespace plumb
