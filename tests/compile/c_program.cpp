// SPDX-License-Identifier: Apache-2.0
#include "c_program.hpp"

#include <dlfcn.h>
#include <stdlib.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace plumb::tests {
namespace {

namespace fs = std::filesystem;

fs::path new_folder() {
  std::string name = (fs::temp_directory_path() / "plumb-c-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  return name;
}

void put(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

std::string text_of(const fs::path& file) {
  std::ostringstream out;
  out << std::ifstream(file, std::ios::binary).rdbuf();
  return out.str();
}

/// A source that includes every header and hands each question to the one it is for.
std::string caller(const std::vector<CHeader>& headers) {
  std::string includes, cases;
  for (std::size_t k = 0; k < headers.size(); ++k) {
    includes += "#include \"" + headers[k].file + "\"\n";
    cases += "    case " + std::to_string(k) + ": return " + headers[k].prefix +
             "_tree_error(q, error_m);\n";
  }
  return includes +
         "#ifdef __cplusplus\nextern \"C\"\n#endif\n"
         "int evaluate(int k, const double *q, double *error_m);\n"
         "int evaluate(int k, const double *q, double *error_m) {\n  switch (k) {\n" +
         cases + "  }\n  return -98;\n}\n";
}

}  // namespace

CProgram::CProgram(const std::vector<CHeader>& headers, const std::string& compiler)
    : folder_(new_folder()) {
  for (const CHeader& header : headers) put(folder_ / header.file, header.text);
  put(folder_ / "caller.c", caller(headers));
  const std::string command = "cd '" + folder_.string() + "' && " + compiler +
                              " -fPIC -shared -nostdlib -Wl,-z,defs -o caller.so caller.c"
                              " > said 2>&1";
  const int status = std::system(command.c_str());
  complaint_ = text_of(folder_ / "said");
  if (status != 0) {
    complaint_ += "[" + compiler + " ended with " + std::to_string(status) + "]";
    return;
  }
  library_ = ::dlopen((folder_ / "caller.so").c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library_ == nullptr) throw std::runtime_error(::dlerror());
  evaluate_ = reinterpret_cast<int (*)(int, const double*, double*)>(::dlsym(library_, "evaluate"));
}

CProgram::~CProgram() {
  if (library_ != nullptr) ::dlclose(library_);
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

CProgram::Answer CProgram::operator()(int k, std::span<const double> q) const {
  Answer out;
  out.error_m.fill(1e9);
  if (evaluate_ != nullptr) out.status = evaluate_(k, q.data(), out.error_m.data());
  return out;
}

}  // namespace plumb::tests
