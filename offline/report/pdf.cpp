// SPDX-License-Identifier: Apache-2.0
#include "report/pdf.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <system_error>

#include "program/child.hpp"
#include "program/file.hpp"
#include "program/problem.hpp"
#include "program/scratch_folder.hpp"

namespace plumb::offline::report {
namespace {

namespace fs = std::filesystem;

constexpr std::array kBrowsers{"chromium", "chromium-browser", "google-chrome",
                               "google-chrome-stable"};
constexpr std::chrono::seconds kLongest{120};
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

int exit_of(const ChildCommand& command) {
  const std::atomic<bool> never{false};
  try {
    return run_to_end(command, kLongest, never).exit_code;
  } catch (const std::system_error& error) {
    no_pdf(error.code() == std::errc::timed_out
               ? fmt::format("it was not ready after {} s", kLongest.count())
               : error.code().message());
  }
}

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
  const ChildCommand command{
      .words = {browser.string(), "--headless", "--no-sandbox", "--disable-gpu",
                "--disable-background-networking", "--disable-component-update", "--disable-sync",
                "--disable-extensions", "--no-first-run", "--no-default-browser-check",
                "--host-resolver-rules=MAP * ~NOTFOUND",
                "--user-data-dir=" + (folder.path() / "profile").string(), "--no-pdf-header-footer",
                "--print-to-pdf=" + pdf.string(), "file://" + page.string()},
      .folder = folder.path(),
      .group = ChildCommand::Group::kWithItsChildren};
  const int exit = exit_of(command);
  if (exit != 0) no_pdf(fmt::format("{} ended with {}", browser.string(), exit));
  std::error_code error;
  if (!fs::exists(pdf, error)) no_pdf("it wrote no file");
  return read_file(pdf);
}

}  // namespace plumb::offline::report
