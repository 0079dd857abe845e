// SPDX-License-Identifier: Apache-2.0
#include "program/scratch_folder.hpp"

#include <stdlib.h>

#include <cerrno>
#include <system_error>

namespace plumb {

namespace fs = std::filesystem;

ScratchFolder::ScratchFolder(const std::string& begins) {
  std::string name = (fs::temp_directory_path() / (begins + "XXXXXX")).string();
  if (::mkdtemp(name.data()) == nullptr) throw std::system_error(errno, std::generic_category());
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace plumb
