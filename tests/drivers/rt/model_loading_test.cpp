// SPDX-License-Identifier: Apache-2.0
#include "rt/model_loading.hpp"

#include <gtest/gtest.h>
#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <optional>
#include <set>
#include <thread>

#include "tests/drivers/deployed.hpp"
#include "tests/drivers/rt/folder_text.hpp"
#include "tests/drivers/rt/problem_of.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;

class ModelLoadings : public testing::Test {
 protected:
  NextModel next(const std::string& name, const std::string& serial = "UR-1") const {
    return {.file = folder.folder / name,
            .serial = serial,
            .etc = folder.folder / "no-etc",
            .place = {},
            .written = {}};
  }
  /// Ten seconds at most.
  static bool wait_for(const ModelLoading& loading) {
    for (int i = 0; i < 10'000 && !loading.done(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return loading.done();
  }
  static std::set<std::string> threads() {
    std::set<std::string> out;
    for (const auto& one : fs::directory_iterator("/proc/self/task"))
      out.insert(one.path().filename().string());
    return out;
  }
  /// The signals that a thread of this process blocks, as the kernel shows them; none if it ended.
  static std::optional<std::uint64_t> blocked_by(const std::string& thread) {
    const std::string text = tests::whole_text("/proc/self/task/" + thread + "/status");
    const std::size_t at = text.find("SigBlk:\t");
    if (at == std::string::npos) return std::nullopt;
    return std::stoull(text.substr(at + 8, 16), nullptr, 16);
  }
  const tests::Deployed folder;
};

TEST_F(ModelLoadings, WhatItReadsIsWhatAReaderThatWaitsReads) {
  ModelLoading loading(next("robot.plumb"));
  ASSERT_TRUE(wait_for(loading));
  const RunningModel read = loading.result();
  ASSERT_NE(read.loaded, nullptr);
  EXPECT_EQ(read.sha256, sha256(tests::whole_text(folder.folder / "robot.plumb")));
  EXPECT_EQ(read.loaded->model(), tests::Deployed::arm());
}

/// The thread must not end the program by what it throws.
TEST_F(ModelLoadings, ARefusalReachesTheOneWhoAsksForTheResult) {
  folder.write("text.plumb", "no model");
  for (const auto& [asked, code] :
       {std::pair{next("robot.plumb", "UR-2"), "E-RT-SERIAL"},
        std::pair{next("text.plumb"), "E-RT-MODEL"}, std::pair{next("none.plumb"), "E-READ"}}) {
    ModelLoading loading(asked);
    ASSERT_TRUE(wait_for(loading));
    EXPECT_EQ(tests::problem_of([&] { std::ignore = loading.result(); }).code, code);
  }
}

TEST_F(ModelLoadings, SeveralAtATimeDoNotTakeEachOthersModel) {
  for (const char* const name : {"1.plumb", "2.plumb", "3.plumb"}) {
    format::Model model = tests::Deployed::arm();
    model.cell_name = name;
    folder.write_model(name, model);
  }
  ModelLoading one(next("1.plumb")), two(next("2.plumb")), three(next("3.plumb"));
  int i = 0;
  for (ModelLoading* const loading : {&one, &two, &three}) {
    ASSERT_TRUE(wait_for(*loading));
    EXPECT_EQ(loading->result().loaded->model().cell_name, std::to_string(++i) + ".plumb");
  }
}

TEST_F(ModelLoadings, WhoDoesNotWaitLeavesNoThreadBehind) {
  const auto before = threads();
  for (int i = 0; i < 20; ++i) ModelLoading(next(i % 2 == 0 ? "robot.plumb" : "none.plumb"));
  for (int i = 0; i < 10'000 && threads() != before; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ(threads(), before);
}

/// A signal that ends the program must reach the thread that ramps out. The model is large, so that
/// its thread is looked at again and again while it reads: a thread that begins, and one that ends,
/// block all signals in any case.
TEST_F(ModelLoadings, ItsThreadTakesNoSignalAndTheOneThatBeganItTakesThoseOfBefore) {
  std::ofstream(folder.folder / "large.plumb") << "no model";
  fs::resize_file(folder.folder / "large.plumb", kMostModelBytes);
  sigset_t own, outer, after;
  sigemptyset(&own);
  sigaddset(&own, SIGUSR1);
  pthread_sigmask(SIG_SETMASK, &own, &outer);
  std::uint64_t always = ~std::uint64_t{0};
  int looks = 0;
  for (int i = 0; i < 50 && looks < 20; ++i) {
    const auto before = threads();
    const ModelLoading loading(next("large.plumb"));
    for (const std::string& thread : threads())
      while (!before.contains(thread) && !loading.done()) {
        const auto blocked = blocked_by(thread);
        if (!blocked || loading.done()) break;
        always &= *blocked;
        ++looks;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    ASSERT_TRUE(wait_for(loading));
  }
  pthread_sigmask(SIG_SETMASK, &outer, &after);
  EXPECT_EQ(sigismember(&after, SIGUSR1), 1);
  EXPECT_EQ(sigismember(&after, SIGTERM), 0);
  EXPECT_GE(looks, 20) << "the thread was seen too seldom";
  for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGUSR1, SIGUSR2, SIGALRM})
    EXPECT_TRUE((always >> (signal - 1) & 1) != 0) << signal;
}

}  // namespace
}  // namespace plumb::drivers::rt
