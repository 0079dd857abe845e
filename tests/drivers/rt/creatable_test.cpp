// SPDX-License-Identifier: Apache-2.0
#include "rt/creatable.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cerrno>

#include "program/scratch_folder.hpp"
#include "tests/drivers/child.hpp"
#include "tests/drivers/rights.hpp"
#include "tests/drivers/rt/folder_text.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;

/// What the system says when the file is made: 0 or its errno.
int error_of_making(const fs::path& file) {
  const int fd = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (fd < 0) return errno;
  ::close(fd);
  return 0;
}

TEST(Creatable, SaysBeforeWhatTheSystemSaysThenAndMakesNothing) {
  const ScratchFolder scratch("plumb-creatable-");
  const fs::path& folder = scratch.path();
  std::ofstream(folder / "file") << "x";
  fs::create_directory(folder / "below");
  fs::create_symlink("below", folder / "to-below");
  fs::create_symlink("nowhere", folder / "to-nowhere");
  fs::create_symlink("circle", folder / "circle");
  for (const fs::path name :
       {"file", "below", "to-below", "to-nowhere", "circle", "file/new", "missing/new",
        "to-nowhere/new", "circle/new", "below/../file", "new", "below/new", "to-below/another",
        "below/../third", "missing/../fourth"}) {
    const auto before = tests::folder_text(folder);
    const int said = creation_error(folder / name);
    EXPECT_EQ(tests::folder_text(folder), before) << name;
    EXPECT_EQ(said, error_of_making(folder / name)) << name;
  }
  const std::string long_name(300, 'x');
  EXPECT_EQ(creation_error(folder / long_name), error_of_making(folder / long_name));
}

TEST(Creatable, AFolderInWhichThisUserMayNotWriteIsNamedSo) {
  const ScratchFolder scratch("plumb-creatable-");
  fs::create_directory(scratch.path() / "locked");
  ::chmod(scratch.path().c_str(), 0755);
  ::chmod((scratch.path() / "locked").c_str(), 0555);
  EXPECT_EQ(tests::in_child([&] {
              tests::become_nobody();
              const fs::path file = scratch.path() / "locked" / "new";
              const int said = creation_error(file);
              return said == error_of_making(file) ? said : 255;
            }),
            EACCES);
}

}  // namespace
}  // namespace plumb::drivers::rt
