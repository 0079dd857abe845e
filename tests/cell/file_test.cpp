// SPDX-License-Identifier: Apache-2.0
#include "program/file.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>

#include <thread>

#include "program/bounded_file.hpp"
#include "program/output_files.hpp"
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

TEST(File, AWriterThatIsKilledLeavesNothingBehind) {
  const Folder folder;
  const int nameless = ::open(folder.path().c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0644);
  if (nameless < 0) GTEST_SKIP() << "this file system has no files without a name";
  ::close(nameless);
  const auto file = folder.put("cell.toml", "old");
  const pid_t writer = ::fork();
  if (writer == 0) {
    // The signal of a file that grows too large kills at once, as kill -9 would.
    const FullDisk full(1000);
    std::signal(SIGXFSZ, SIG_DFL);
    write_file_atomically(file, std::string(5000, 'x'));
    ::_exit(0);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(writer, &status, 0), writer);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(entries(folder.path()), 1);
  EXPECT_EQ(read_file(file), "old");
}

/// A process that is no more.
pid_t gone() {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  ::waitpid(child, nullptr, 0);
  return child;
}

TEST(File, TheNextWriterRemovesDraftsOfTheSameFileWhoseWritersAreGone) {
  const Folder folder;
  const std::string dead = std::to_string(gone()), alive = std::to_string(::getpid());
  const auto draft = [&](const std::string& name, std::chrono::minutes age) {
    const auto file = folder.put(name, "half");
    fs::last_write_time(file, fs::file_time_type::clock::now() - age);
    return file;
  };
  using std::chrono::minutes;
  const auto stale = draft("a." + dead + "-17-0.tmp", minutes(5));
  const auto fresh = draft("a." + dead + "-18-0.tmp", minutes(0));
  const auto living = draft("a." + alive + "-17-0.tmp", minutes(5));
  const auto other = draft("b." + dead + "-17-0.tmp", minutes(5));
  const auto users = draft("a.tmp", minutes(5));
  const auto named = draft("a.1-2-3.old.tmp", minutes(5));
  write_file_atomically(folder.path() / "a", "new");
  EXPECT_FALSE(fs::exists(stale));
  for (const auto& kept : {fresh, living, other, users, named})
    EXPECT_TRUE(fs::exists(kept)) << kept;
  EXPECT_EQ(read_file(folder.path() / "a"), "new");
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

TEST(File, LargerThanItsKindMayBeIsRefusedBeforeItIsRead) {
  const Folder folder;
  const auto file = folder.put("cell.toml", "");
  fs::resize_file(file, kMostCellBytes + 1);  // a hole: takes no room on the disk
  const auto codes = [](const fs::path& which, std::uintmax_t most) {
    const auto problems = problems_of([&] { read_file_up_to(which, most); });
    return problems.empty() ? std::string() : problems[0].code;
  };
  EXPECT_EQ(codes(file, kMostCellBytes), "E-READ-SIZE");
  EXPECT_EQ(codes(file, kMostCellBytes + 1), "");
  EXPECT_EQ(codes("/dev/zero", 1 << 20), "E-READ-SIZE");
  EXPECT_EQ(codes("/dev/null", 1 << 20), "");
  fs::resize_file(file, kMostFileBytes + 1);
  EXPECT_EQ(problems_of([&] { read_file(file); }).at(0).code, "E-READ-SIZE");
}

TEST(File, APipeIsReadUpToItsBound) {
  const Folder folder;
  const auto pipe = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const auto fill = [&](std::size_t bytes) {
    return std::thread([=] { std::ofstream(pipe) << std::string(bytes, 'x'); });
  };
  std::signal(SIGPIPE, SIG_IGN);
  std::thread few = fill(100000);
  EXPECT_EQ(read_file_up_to(pipe, 100000).size(), 100000u);
  few.join();
  std::thread many = fill(100001);
  EXPECT_EQ(problems_of([&] { read_file_up_to(pipe, 100000); }).size(), 1u);
  many.join();
}

TEST(File, IsNamedShortlyBelowTheWorkingDirectory) {
  EXPECT_EQ(display_name(fs::current_path() / "a" / "b.csv"), "a/b.csv");
  EXPECT_EQ(display_name("/elsewhere/b.csv"), "/elsewhere/b.csv");
  EXPECT_EQ(display_name("b.csv"), "b.csv");
  const fs::path here = fs::current_path();
  fs::current_path("/");
  EXPECT_EQ(display_name("/elsewhere/b.csv"), "/elsewhere/b.csv");
  fs::current_path(here);
}

TEST(File, AFolderThatWritingMakesIsNamed) {
  const Folder folder;
  EXPECT_FALSE(folder_note(folder.path() / "a.csv", {}));
  const auto note = folder_note(folder.path() / "new" / "deep" / "a.csv", {});
  ASSERT_TRUE(note);
  EXPECT_EQ(note->code, "N-WRITE-FOLDER");
  EXPECT_NE(note->message.find((folder.path() / "new").string() + ":"), std::string::npos)
      << note->message;
}

TEST(Sha256, AgreesWithTheVectorsOfFips180) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256(std::string(1000000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(OutputFiles, NeverReplaceWhatWasReadOrIsKept) {
  const Folder folder;
  const fs::path read = folder.put("read.csv", "a"), kept = folder.put("kept.toml", "b");
  const fs::path inside = folder.put("runs.json", "c"), other = folder.put("other.csv", "d");
  fs::create_hard_link(read, read.parent_path() / "hard.csv");
  fs::create_symlink(kept, read.parent_path() / "link.toml");
  Outcome outcome;
  outcome.inputs.push_back({read.string(), ""});
  outcome.kept = {kept};
  const auto code_of = [&](const fs::path& file) -> std::string {
    try {
      refuse_kept(file, outcome);
      return "";
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.exit_code(), Exit::kUsage);
      return failure.problems().front().code;
    }
  };
  for (const char* name : {"read.csv", "kept.toml", "hard.csv", "link.toml", "./read.csv"})
    EXPECT_EQ(code_of(read.parent_path() / name), "E-OUTPUT-INPUT") << name;
  EXPECT_EQ(code_of(other), "");
  EXPECT_EQ(code_of(read.parent_path() / "new.csv"), "");
  EXPECT_EQ(code_of("/dev/null"), "");
  outcome.kept = {read.parent_path()};
  EXPECT_EQ(code_of(inside), "E-OUTPUT-INPUT") << "a folder is kept with all that is in it";
}

}  // namespace
}  // namespace plumb::offline
