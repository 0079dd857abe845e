// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "golden_models.hpp"
#include "plumb/format/crc32.hpp"
#include "plumb/format/reader.hpp"
#include "plumb/format/writer.hpp"

namespace plumb::format {
namespace {

namespace fs = std::filesystem;

fs::path golden(const std::string& name) { return fs::path(PLUMB_GOLDEN) / (name + ".plumb"); }

std::vector<std::byte> bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

TEST(Golden, FilesOfSchemaOneReadToTheContentTheyWereMadeOf) {
  for (const auto& [name, model] : golden_models()) {
    const auto read = read_model(golden(name));
    ASSERT_TRUE(std::holds_alternative<Model>(read)) << std::get<ReadError>(read).detail;
    EXPECT_EQ(std::get<Model>(read), model) << name;
  }
}

TEST(Golden, TheWriterStillMakesTheSameBytes) {
  for (const auto& [name, model] : golden_models())
    EXPECT_EQ(write_model(model), bytes_of(golden(name))) << name;
}

TEST(Golden, WritingAndReadingChangesNothing) {
  Model m = six_axis_model();
  m.serial = "Größe 7 µ";
  m.trees[2] = m.trees[0];
  m.effects.push_back(
      {.name = "tool_sag", .version = 3, .joints = {}, .parameters = {1.0}, .context = {}});
  const auto read = read_model(write_model(m));
  ASSERT_TRUE(std::holds_alternative<Model>(read));
  EXPECT_EQ(std::get<Model>(read), m);
}

TEST(Crc32P4, GivesThePublishedCheckValue) {
  const std::string digits = "123456789";
  EXPECT_EQ(crc32p4(std::as_bytes(std::span(digits))), 0x1697D06AU);
}

ReadErrorCode code_of(const std::variant<Model, ReadError>& read) {
  return std::holds_alternative<ReadError>(read) ? std::get<ReadError>(read).code
                                                 : ReadErrorCode{255};
}

TEST(Reader, ANewerSchemaIsNamedAsSuch) {
  // The version is the only u32 of value 1 that alone turns the file into one of schema 2.
  auto bytes = write_model(planar_model());
  bool found = false;
  for (std::size_t i = 0; i + 20 < bytes.size() && !found; ++i) {
    auto newer = bytes;
    if (newer[i] != std::byte{1}) continue;
    newer[i] = std::byte{2};
    const std::size_t sum = newer.size() - 4;
    const std::uint32_t crc = crc32p4(std::span(newer).first(sum));
    for (std::size_t k = 0; k < 4; ++k) newer[sum + k] = static_cast<std::byte>(crc >> (8 * k));
    found = code_of(read_model(newer)) == ReadErrorCode::kNewerSchema;
  }
  EXPECT_TRUE(found);
}

TEST(Reader, ForeignEmptyMissingHugeFilesAndFoldersAreToldApart) {
  const fs::path folder = fs::temp_directory_path() / "plumb-reader-test";
  fs::create_directories(folder);
  const fs::path foreign = folder / "foreign", empty = folder / "empty", huge = folder / "huge";
  std::ofstream(foreign) << std::string(1000, 'x');
  std::ofstream(empty).flush();
  std::ofstream(huge).flush();
  fs::resize_file(huge, kMaxFileBytes + 1);
  EXPECT_EQ(code_of(read_model(foreign)), ReadErrorCode::kNotAModel);
  EXPECT_EQ(code_of(read_model(empty)), ReadErrorCode::kTruncated);
  EXPECT_EQ(code_of(read_model(huge)), ReadErrorCode::kTooLarge);
  EXPECT_EQ(code_of(read_model(folder)), ReadErrorCode::kCannotOpen);
  EXPECT_EQ(code_of(read_model(folder / "missing")), ReadErrorCode::kCannotOpen);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace plumb::format
