// SPDX-License-Identifier: Apache-2.0
// What is not a model, and how the reader says so.
#include "plumb/format/reader.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "golden_models.hpp"
#include "plumb/format/crc32.hpp"
#include "plumb/format/writer.hpp"
#include "seal.hpp"

namespace plumb::format {
namespace {

namespace fs = std::filesystem;

ReadErrorCode code_of(const std::variant<Model, ReadError>& read) {
  return std::holds_alternative<ReadError>(read) ? std::get<ReadError>(read).code
                                                 : ReadErrorCode{255};
}

class ReaderOfFiles : public ::testing::Test {
 protected:
  ReaderOfFiles() { fs::create_directories(folder_); }
  ~ReaderOfFiles() override { fs::remove_all(folder_); }

  fs::path file(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return folder_ / name;
  }

  const fs::path folder_ =
      fs::temp_directory_path() / ("plumb-reader-test-" + std::to_string(getpid()));
};

TEST(Crc32P4, GivesThePublishedCheckValue) {
  const std::string digits = "123456789";
  EXPECT_EQ(crc32p4(std::as_bytes(std::span(digits))), 0x1697D06AU);
}

TEST(Crc32P4, IsTheRemainderOfALongDivision) {
  Bytes bytes;
  std::uint32_t state = 7;
  for (int size = 0; size < 600; ++size) {
    EXPECT_EQ(crc32p4(bytes), divided_crc(bytes.data(), bytes.size())) << size;
    state = state * 1664525U + 1013904223U;
    bytes.push_back(static_cast<std::byte>(state >> 24));
  }
}

TEST_F(ReaderOfFiles, CallsAForeignFileForeignHoweverShort) {
  for (std::size_t size : {1U, 7U, 8U, 15U, 16U, 1000U})
    EXPECT_EQ(code_of(read_model(file("foreign", std::string(size, 'x')))),
              ReadErrorCode::kNotAModel)
        << size;
  EXPECT_EQ(code_of(read_model(file("table", "pose,q1_deg,x_mm\n1,0,0\n"))),
            ReadErrorCode::kNotAModel);
}

TEST_F(ReaderOfFiles, CallsAnEmptyFileTruncated) {
  EXPECT_EQ(code_of(read_model(file("empty", ""))), ReadErrorCode::kTruncated);
}

TEST_F(ReaderOfFiles, RefusesAHugeFileWithoutReadingIt) {
  const fs::path huge = file("huge", "");
  fs::resize_file(huge, kMaxFileBytes + std::uintmax_t{1});
  EXPECT_EQ(code_of(read_model(huge)), ReadErrorCode::kTooLarge);
  const Bytes in_memory(kMaxFileBytes + 1);
  EXPECT_EQ(code_of(read_model(in_memory)), ReadErrorCode::kTooLarge);
}

TEST_F(ReaderOfFiles, CannotOpenWhatIsMissingOrNoFile) {
  EXPECT_EQ(code_of(read_model(folder_)), ReadErrorCode::kCannotOpen);
  EXPECT_EQ(code_of(read_model(folder_ / "missing")), ReadErrorCode::kCannotOpen);
  EXPECT_EQ(code_of(read_model(file("plain", "x") / "below")), ReadErrorCode::kCannotOpen);
  EXPECT_EQ(code_of(read_model(fs::path("/dev/zero"))), ReadErrorCode::kCannotOpen);
}

TEST_F(ReaderOfFiles, NamesItsSizeWhenAModelIsCutShort) {
  const Bytes whole = write_model(planar_model());
  const std::string text(reinterpret_cast<const char*>(whole.data()), 700);
  const auto read = read_model(file("cut.plumb", text));
  ASSERT_EQ(code_of(read), ReadErrorCode::kTruncated);
  EXPECT_NE(std::get<ReadError>(read).detail.find("700"), std::string::npos);
}

}  // namespace
}  // namespace plumb::format
