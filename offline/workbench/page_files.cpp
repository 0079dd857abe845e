// SPDX-License-Identifier: Apache-2.0
#include "workbench/page_files.hpp"

#include <array>
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include "program/bounded_file.hpp"
#include "program/file.hpp"

#ifdef PLUMB_PAGE_DIR
// The assembler puts the files that npm built and gzip packed between two names each.
#define PLUMB_INCLUDE(name, file)                                                   \
  __asm__(".section .rodata\n.global plumb_page_" name "\n.global plumb_page_" name \
          "_end\n"                                                                  \
          "plumb_page_" name ":\n.incbin \"" PLUMB_PAGE_DIR "/" file                \
          ".gz\"\n"                                                                 \
          "plumb_page_" name "_end:\n.byte 0\n.previous\n")
PLUMB_INCLUDE("html", "index.html");
PLUMB_INCLUDE("js", "app.js");
PLUMB_INCLUDE("css", "app.css");
extern "C" const char plumb_page_html[], plumb_page_html_end[], plumb_page_js[],
    plumb_page_js_end[], plumb_page_css[], plumb_page_css_end[];
#endif

namespace plumb::offline::workbench {
namespace {

struct PageFile {
  std::string_view name;
  const char* type;
  std::string_view packed;
};

#ifdef PLUMB_PAGE_DIR
#define PLUMB_PACKED(name)            \
  std::string_view(plumb_page_##name, \
                   static_cast<std::size_t>(plumb_page_##name##_end - plumb_page_##name))
#else
#define PLUMB_PACKED(name) std::string_view()
#endif

const std::array<PageFile, 3>& page_files() {
  static const std::array<PageFile, 3> all{
      {{"index.html", "text/html; charset=utf-8", PLUMB_PACKED(html)},
       {"app.js", "text/javascript; charset=utf-8", PLUMB_PACKED(js)},
       {"app.css", "text/css; charset=utf-8", PLUMB_PACKED(css)}}};
  return all;
}

Response page_response(const PageFile& file, std::string content, Response::Encoding encoding) {
  return {.type = file.type,
          .body = bytes(content),
          .etag = sha256(content).substr(0, 16),
          .encoding = encoding,
          .content = Response::Content::kPage};
}

}  // namespace

std::optional<Response> page_file(const std::string& name) {
  for (const PageFile& file : page_files()) {
    if (file.name != name) continue;
    if (const char* const folder = std::getenv("PLUMB_PAGE"))
      return page_response(file, read_file_up_to(std::filesystem::path(folder) / name, 16U << 20),
                           Response::Encoding::kPlain);
    if (file.packed.empty()) return std::nullopt;
    return page_response(file, std::string(file.packed), Response::Encoding::kGzip);
  }
  return std::nullopt;
}

}  // namespace plumb::offline::workbench
