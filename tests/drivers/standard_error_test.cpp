// SPDX-License-Identifier: Apache-2.0
#include "rt/standard_error.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <string>

#include "rt/journal.hpp"

namespace plumb::drivers::rt {
namespace {

/// Puts another file in the place of stderr for as long as it lives.
class StderrReplaced {
 public:
  explicit StderrReplaced(int by) { ::dup2(by, STDERR_FILENO); }
  ~StderrReplaced() {
    ::dup2(before_, STDERR_FILENO);
    ::close(before_);
  }
  StderrReplaced(const StderrReplaced&) = delete;
  StderrReplaced& operator=(const StderrReplaced&) = delete;

 private:
  int before_ = ::dup(STDERR_FILENO);
};

enum class Kind { kPipe, kSocket };

/// [0]: who reads, [1]: stderr.
std::array<int, 2> made(Kind kind) {
  std::array<int, 2> out{};
  const int result =
      kind == Kind::kPipe ? ::pipe(out.data()) : ::socketpair(AF_UNIX, SOCK_STREAM, 0, out.data());
  EXPECT_EQ(result, 0);
  return out;
}

bool said_on(int stream, const std::string& line) {
  const StderrReplaced now(stream);
  return say_at_once(line);
}

TEST(StandardError, ALineArrivesWhereThereIsRoom) {
  for (const Kind kind : {Kind::kPipe, Kind::kSocket}) {
    const auto ends = made(kind);
    EXPECT_TRUE(said_on(ends[1], "one line\n"));
    char got[64];
    EXPECT_EQ(::read(ends[0], got, sizeof got), 9);
    ::close(ends[0]);
    ::close(ends[1]);
  }
}

TEST(StandardError, AReaderThatTakesNothingHoldsNobodyUp) {
  const std::string line(200, 'x');
  for (const Kind kind : {Kind::kPipe, Kind::kSocket}) {
    const auto ends = made(kind);
    int said = 0;
    while (said < 100'000 && said_on(ends[1], line)) ++said;  // a waiting call would end never
    EXPECT_LT(said, 100'000);
    EXPECT_EQ(::fcntl(ends[1], F_GETFL) & O_NONBLOCK, 0) << "others share the stream";
    const StderrReplaced now(ends[1]);
    Journal({}, Journal::Echo::kStderr).note("end", {{"cycles", 1}});
    ::close(ends[0]);
    ::close(ends[1]);
  }
}

TEST(StandardError, AReaderThatIsGoneEndsNobody) {
  for (const Kind kind : {Kind::kPipe, Kind::kSocket}) {
    const auto ends = made(kind);
    ::close(ends[0]);
    EXPECT_FALSE(said_on(ends[1], "to nobody\n"));
    ::close(ends[1]);
  }
}

TEST(StandardError, AFileGetsLineAfterLine) {
  const std::string name = testing::TempDir() + "/stderr-" + std::to_string(::getpid());
  const int file = ::open(name.c_str(), O_RDWR | O_CREAT | O_TRUNC, 0600);
  ASSERT_GE(file, 0);
  EXPECT_TRUE(said_on(file, "one\n"));
  EXPECT_TRUE(said_on(file, "two\n"));
  char got[64];
  EXPECT_EQ(std::string(got, static_cast<std::size_t>(::pread(file, got, sizeof got, 0))),
            "one\ntwo\n");
  ::close(file);
  ::unlink(name.c_str());
}

}  // namespace
}  // namespace plumb::drivers::rt
