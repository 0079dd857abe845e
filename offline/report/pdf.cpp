// SPDX-License-Identifier: Apache-2.0
#include "report/pdf.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <thread>
#include <vector>

#include "program/file.hpp"
#include "program/problem.hpp"
#include "program/scratch_folder.hpp"

namespace plumb::offline::report {
namespace {

namespace fs = std::filesystem;
using std::chrono::steady_clock;

constexpr std::array kBrowsers{"chromium", "chromium-browser", "google-chrome",
                               "google-chrome-stable"};
constexpr std::chrono::seconds kLongest{120};
constexpr std::chrono::milliseconds kBetweenLooks{20};
constexpr const char* kPrintYourself =
    "leave out --pdf, open the report in any browser and print it there";

[[noreturn]] void no_pdf(const std::string& why) {
  throw Failure(Exit::kEnvironment, {.code = "E-REPORT-PDF",
                                     .message = "the browser made no PDF: " + why,
                                     .help = kPrintYourself});
}

ScratchFolder temporary_folder() {
  try {
    return ScratchFolder("plumb-report-");
  } catch (const std::system_error& error) {
    no_pdf("no temporary folder: " + error.code().message());
  }
}

/// A program in a process group of its own, with its output thrown away; killed with all its
/// children if it is still there at the end.
class Child {
 public:
  explicit Child(const std::vector<std::string>& words) {
    std::vector<char*> argv;
    for (const auto& word : words) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    const int error = ::posix_spawn(&pid_, argv.front(), &files, &attributes, argv.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
    if (error != 0) {
      pid_ = 0;
      no_pdf(std::strerror(error));
    }
  }
  ~Child() {
    if (pid_ <= 0) return;
    ::kill(-pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Whether it ended by itself before that time; its exit code, or -1, goes to `exit`.
  bool ends_before(steady_clock::time_point end, int& exit) {
    while (steady_clock::now() < end) {
      int status = 0;
      if (::waitpid(pid_, &status, WNOHANG) == pid_) {
        pid_ = 0;
        exit = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
        return true;
      }
      std::this_thread::sleep_for(kBetweenLooks);
    }
    return false;
  }

 private:
  pid_t pid_ = 0;
};

bool is_program(const fs::path& file) {
  std::error_code error;
  return fs::is_regular_file(file, error) && ::access(file.c_str(), X_OK) == 0;
}

}  // namespace

fs::path find_browser() {
  const char* variable = std::getenv("PATH");
  const std::string path = variable == nullptr ? "" : variable;
  for (const char* name : kBrowsers)
    for (std::size_t from = 0; from <= path.size();) {
      const auto end = std::min(path.find(':', from), path.size());
      const fs::path file = fs::path(path.substr(from, end - from)) / name;
      if (end > from && is_program(file)) return file;
      from = end + 1;
    }
  throw Failure(Exit::kEnvironment,
                {.code = "E-REPORT-BROWSER",
                 .message = fmt::format("--pdf needs a browser on PATH that prints: {}",
                                        fmt::join(kBrowsers, ", ")),
                 .help = std::string("install chromium; or ") + kPrintYourself});
}

std::string printed_pdf(const fs::path& browser, const std::string& html) {
  const ScratchFolder folder = temporary_folder();
  const fs::path page = folder.path() / "report.html", pdf = folder.path() / "report.pdf";
  write_file_atomically(page, html);
  Child child({browser.string(), "--headless", "--no-sandbox", "--disable-gpu",
               "--disable-background-networking", "--disable-component-update", "--disable-sync",
               "--disable-extensions", "--no-first-run", "--no-default-browser-check",
               "--host-resolver-rules=MAP * ~NOTFOUND",
               "--user-data-dir=" + (folder.path() / "profile").string(), "--no-pdf-header-footer",
               "--print-to-pdf=" + pdf.string(), "file://" + page.string()});
  int exit = 0;
  if (!child.ends_before(steady_clock::now() + kLongest, exit))
    no_pdf(fmt::format("it was not ready after {} s", kLongest.count()));
  if (exit != 0) no_pdf(fmt::format("{} ended with {}", browser.string(), exit));
  std::error_code error;
  if (!fs::exists(pdf, error)) no_pdf("it wrote no file");
  return read_file(pdf);
}

}  // namespace plumb::offline::report
