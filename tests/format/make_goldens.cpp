// SPDX-License-Identifier: Apache-2.0
// make_goldens FOLDER: writes the golden files. Run it only for a new schema, never to make a test
// pass.
#include <cstdio>
#include <fstream>

#include "golden_models.hpp"
#include "plumb/format/writer.hpp"

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "usage: make_goldens FOLDER\n");
    return 2;
  }
  for (const auto& [name, model] : plumb::format::golden_models()) {
    const auto bytes = plumb::format::write_model(model);
    std::ofstream out(std::string(arguments[1]) + "/" + name + ".plumb", std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes.data()),
              static_cast<std::streamsize>(bytes.size()));
  }
  return 0;
}
