// SPDX-License-Identifier: Apache-2.0
// Files that were written once are read for ever, and the writer still makes the same bytes.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>

#include "consistency.hpp"
#include "golden_models.hpp"
#include "plumb/format/reader.hpp"
#include "plumb/format/writer.hpp"
#include "seal.hpp"

namespace plumb::format {
namespace {

namespace fs = std::filesystem;

fs::path golden(const std::string& name) { return fs::path(PLUMB_GOLDEN) / (name + ".plumb"); }

Bytes bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

TEST(Golden, FilesOfEverySchemaReadToTheContentTheyWereMadeOf) {
  for (const auto& [name, model] : golden_models()) {
    const auto read = read_model(golden(name));
    ASSERT_TRUE(std::holds_alternative<Model>(read)) << std::get<ReadError>(read).detail;
    EXPECT_EQ(std::get<Model>(read), model) << name;
    EXPECT_EQ(inconsistency(model), "") << name;
  }
}

TEST(Golden, TheWriterStillMakesTheSameBytes) {
  for (const auto& [name, model] : golden_models())
    EXPECT_EQ(write_model(model), bytes_of(golden(name))) << name;
}

TEST(Golden, EachFileIsOfTheLowestSchemaThatCanSayIt) {
  for (const auto& golden_model : golden_models()) {
    const std::string& name = golden_model.first;
    const std::uint32_t lowest = name == "coupled" ? 3U : name == "blended" ? 2U : 1U;
    EXPECT_EQ(stated_schema(bytes_of(golden(name))), lowest) << name;
  }
}

TEST(Golden, EveryFileHasAModelItIsHeldTo) {
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(PLUMB_GOLDEN))
    files += entry.path().extension() == ".plumb" ? 1 : 0;
  EXPECT_EQ(files, golden_models().size());
}

}  // namespace
}  // namespace plumb::format
