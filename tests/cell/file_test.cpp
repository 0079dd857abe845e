// SPDX-License-Identifier: Apache-2.0
#include "program/file.hpp"

#include <sys/resource.h>
#include <sys/stat.h>
#include <csignal>

#include <thread>

#include "support.hpp"

namespace plumb::offline {
namespace {

namespace fs = std::filesystem;

int entries(const fs::path& folder) {
  return static_cast<int>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

/// No file may grow beyond `bytes` while this lives: a disk that is full.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &before_);
    rlimit now = before_;
    now.rlim_cur = bytes;
    ::setrlimit(RLIMIT_FSIZE, &now);
  }
  ~FullDisk() { ::setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

TEST(File, WritesAndReadsEveryByte) {
  const Folder folder;
  std::string bytes;
  for (int i = 0; i < 200000; ++i) bytes += static_cast<char>(i * 31 % 256);
  write_file_atomically(folder.path() / "a", bytes);
  EXPECT_EQ(read_file(folder.path() / "a"), bytes);
  write_file_atomically(folder.path() / "a", "");
  EXPECT_EQ(read_file(folder.path() / "a"), "");
  EXPECT_EQ(entries(folder.path()), 1);
}

TEST(File, KeepsTheOldOneAndLeavesNoDraftWhenTheDiskIsFull) {
  const Folder folder;
  const auto file = folder.put("cell.toml", "old");
  std::vector<Problem> problems;
  Exit exit = Exit::kDone;
  {
    const FullDisk full(1000);
    try {
      write_file_atomically(file, std::string(5000, 'x'));
    } catch (const Failure& failure) {
      problems = failure.problems();
      exit = failure.exit_code();
    }
  }
  EXPECT_EQ(exit, Exit::kEnvironment);
  ASSERT_EQ(summary(problems), Summary{"E-WRITE 0:0"});
  EXPECT_NE(problems[0].message.find("File too large"), std::string::npos);
  EXPECT_EQ(read_file(file), "old");
  EXPECT_EQ(entries(folder.path()), 1);
}

TEST(File, SaysWhyItCannotWrite) {
  const Folder folder;
  const auto reason = [](const fs::path& file) {
    const auto problems = problems_of([&] { write_file_atomically(file, "x"); });
    return problems.empty() ? std::string() : problems[0].code + ": " + problems[0].message;
  };
  EXPECT_NE(reason(folder.path()).find("Is a directory"), std::string::npos);
  EXPECT_NE(reason(folder.path() / "no" / "a").find("No such file"), std::string::npos);
  EXPECT_NE(reason(folder.put("f", "") / "a").find("Not a directory"), std::string::npos);
}

TEST(File, KeepsThePermissionsOfWhatItReplacesAndALinkALink) {
  const Folder folder;
  const auto file = folder.put("real", "old");
  ::chmod(file.c_str(), 0640);
  fs::create_symlink("real", folder.path() / "link");
  write_file_atomically(folder.path() / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder.path() / "link"));
  EXPECT_EQ(read_file(file), "new");
  struct stat present {};
  ASSERT_EQ(::stat(file.c_str(), &present), 0);
  EXPECT_EQ(present.st_mode & 0777, 0640u);
}

TEST(File, WritesIntoAPipeOrADeviceAndLeavesItThere) {
  const Folder folder;
  const auto pipe = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::string heard;
  std::thread reader([&] { heard = read_file(pipe); });
  write_new_file(pipe, "for the reader", Overwrite::kNo);
  reader.join();
  EXPECT_EQ(heard, "for the reader");
  EXPECT_TRUE(fs::is_fifo(pipe));
  EXPECT_EQ(entries(folder.path()), 1);
  write_new_file("/dev/null", "gone", Overwrite::kForce);
  write_new_file("/dev/null", "gone", Overwrite::kNo);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_EQ(problems_of([] { write_file_atomically("/dev/full", "x"); })[0].code, "E-WRITE");
}

TEST(File, IsAlwaysOneWholeTextWhileTwoWritersCompete) {
  const Folder folder;
  const auto file = folder.path() / "a";
  const std::string one(20000, '1'), two(30000, '2');
  write_file_atomically(file, one);
  const auto writer = [&](const std::string& text) {
    for (int i = 0; i < 50; ++i) write_file_atomically(file, text);
  };
  std::thread first(writer, one), second(writer, two);
  for (int i = 0; i < 200; ++i) {
    const std::string text = read_file(file);
    EXPECT_TRUE(text == one || text == two);
  }
  first.join();
  second.join();
  EXPECT_EQ(entries(folder.path()), 1);
}

TEST(File, ANewOneNeverReplacesAnotherUnlessForced) {
  const Folder folder;
  const auto file = folder.put("a", "old");
  try {
    write_new_file(file, "new", Overwrite::kNo);
    FAIL() << "it was replaced";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.exit_code(), Exit::kUsage);
    EXPECT_EQ(failure.problems()[0].code, "E-EXISTS");
  }
  EXPECT_EQ(read_file(file), "old");
  write_new_file(file, "new", Overwrite::kForce);
  EXPECT_EQ(read_file(file), "new");
}

TEST(File, SaysWhyItCannotRead) {
  const Folder folder;
  const auto message = [](const fs::path& file) {
    const auto problems = problems_of([&] { read_file(file); });
    return problems.empty() ? std::string() : problems[0].code + ": " + problems[0].message;
  };
  const std::string missing = folder.path() / "missing.csv";
  EXPECT_EQ(message(missing), "E-READ: cannot read " + missing + ": no such file");
  EXPECT_EQ(message(folder.path()),
            "E-READ: cannot read " + folder.path().string() + ": it is a directory");
}

TEST(File, IsNamedShortlyBelowTheWorkingDirectory) {
  EXPECT_EQ(display_name(fs::current_path() / "a" / "b.csv"), "a/b.csv");
  EXPECT_EQ(display_name("/elsewhere/b.csv"), "/elsewhere/b.csv");
  EXPECT_EQ(display_name("b.csv"), "b.csv");
}

TEST(Sha256, AgreesWithTheVectorsOfFips180) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256(std::string(1000000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

}  // namespace
}  // namespace plumb::offline
