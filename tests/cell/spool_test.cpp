// SPDX-License-Identifier: Apache-2.0
#include "program/spool.hpp"

#include <sys/stat.h>

#include <thread>

#include "program/file.hpp"
#include "support.hpp"

namespace plumb::offline {
namespace {

namespace fs = std::filesystem;

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(Spool, AppearsWholeOrNotAtAll) {
  const Folder folder;
  const fs::path file = folder.path() / "new" / "out.csv";
  {
    Spool dropped(file);
    dropped.write("half");
    EXPECT_EQ(files_in(folder.path()), 0U);
  }
  EXPECT_EQ(files_in(folder.path()), 0U);
  Spool kept(file);
  kept.write("one ");
  kept.write("two");
  EXPECT_EQ(files_in(folder.path()), 0U);
  kept.commit(Overwrite::kNo);
  EXPECT_EQ(read_file(file), "one two");
  EXPECT_EQ(files_in(file.parent_path()), 1U);
}

TEST(Spool, ReplacesAFileOnlyIfToldToAndKeepsItsPermissionsAndLinks) {
  const Folder folder;
  const fs::path file = folder.put("out.csv", "before"), link = folder.path() / "link.csv";
  fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("out.csv", link);
  Spool refused(link);
  refused.write("after");
  EXPECT_EQ(problems_of([&] { refused.commit(Overwrite::kNo); }).at(0).code, "E-EXISTS");
  EXPECT_EQ(read_file(file), "before");
  refused.commit(Overwrite::kForce);
  EXPECT_EQ(read_file(file), "after");
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(fs::status(file).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(files_in(folder.path()), 2U);
}

TEST(Spool, IsCopiedIntoAPipe) {
  const Folder folder;
  const fs::path pipe = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const std::string text(3 << 20, 'x');
  std::string got;
  std::thread reader([&] { got = read_file(pipe); });
  Spool spool(pipe);
  spool.write(text);
  spool.commit(Overwrite::kNo);
  reader.join();
  EXPECT_TRUE(got == text);
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST(Spool, AFullDeviceIsAnErrorWithTheReason) {
  const auto problems = problems_of([] {
    Spool spool("/dev/full");
    spool.write("x");
    spool.commit(Overwrite::kForce);
  });
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].code, "E-WRITE");
  EXPECT_NE(problems[0].message.find("No space left"), std::string::npos) << problems[0].message;
}

}  // namespace
}  // namespace plumb::offline
