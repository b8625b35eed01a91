#include "saker/core/files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "saker/core/error.h"

namespace saker::core {
namespace {

namespace fs = std::filesystem;

class FilesTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("saker_files_" +
               std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  int files() const {
    return static_cast<int>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

std::string message(const std::function<void()>& f) {
  try {
    f();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST_F(FilesTest, WhatIsWrittenIsReadAndNothingElseIsLeft) {
  const std::string bytes("a\0b\n", 4);
  write_file(folder_ / "f", bytes);
  EXPECT_EQ(read_file(folder_ / "f"), bytes);
  write_file(folder_ / "f", "");
  EXPECT_EQ(read_file(folder_ / "f"), "");
  EXPECT_EQ(files(), 1);
}

TEST_F(FilesTest, AnUnfinishedFileLeavesTheOldOne) {
  write_file(folder_ / "f", "old");
  {
    OutputFile out(folder_ / "f");
    out.write("ne");
  }
  EXPECT_EQ(read_file(folder_ / "f"), "old");
  EXPECT_EQ(files(), 1);
}

TEST_F(FilesTest, ErrorsNameTheFileAndTheCause) {
  const std::string missing = (folder_ / "none" / "f").string();
  EXPECT_EQ(message([&] { (void)read_file(missing); }),
            "cannot read " + missing + ": No such file or directory");
  EXPECT_EQ(message([&] { write_file(missing, "x"); }),
            "cannot write " + missing + ": No such file or directory");
  EXPECT_EQ(message([&] { (void)read_file(folder_); }),
            "cannot read " + folder_.string() + ": it is a folder");
}

TEST_F(FilesTest, NpyHasTheLayoutOfTheFormat) {
  const std::vector<std::uint32_t> values = {1, 2, 3, 4, 5, 0xFFFFFFFF};
  write_npy(folder_ / "a.npy", values, 2, 3);
  const std::string bytes = read_file(folder_ / "a.npy");
  EXPECT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  const std::size_t header =
      10 + static_cast<std::uint8_t>(bytes[8]) + 256u * static_cast<std::uint8_t>(bytes[9]);
  EXPECT_EQ(header % 64, 0u);
  EXPECT_EQ(bytes[header - 1], '\n');
  EXPECT_NE(bytes.find("{'descr': '<u4', 'fortran_order': False, 'shape': (2, 3), }"),
            std::string::npos);
  ASSERT_EQ(bytes.size(), header + 24);
  EXPECT_EQ(std::memcmp(bytes.data() + header, values.data(), 24), 0);
}

TEST_F(FilesTest, PiecesAreWrittenInTheirOrder) {
  OutputFile out(folder_ / "f");
  out.write("ab");
  const std::vector<std::uint8_t> bytes = {0, 255, 10};
  out.write(bytes);
  out.write("");
  out.write("c");
  EXPECT_FALSE(fs::exists(folder_ / "f")) << "not yet";
  out.finish();
  EXPECT_EQ(read_file(folder_ / "f"), std::string("ab\0\xFF\nc", 6));
  EXPECT_EQ(files(), 1);
}

TEST_F(FilesTest, AMegabyteIsReadBackTheSame) {
  std::string bytes;
  for (unsigned i = 0; i < 1'000'000; ++i) bytes += static_cast<char>(i * 7919 >> 3);
  write_file(folder_ / "f", bytes);
  EXPECT_TRUE(read_file(folder_ / "f") == bytes);
}

TEST_F(FilesTest, AFolderIsNotOverwritten) {
  fs::create_directories(folder_ / "taken" / "by");
  const std::string taken = (folder_ / "taken").string();
  EXPECT_EQ(message([&] { write_file(taken, "x"); }).find("cannot write " + taken), 0u);
  EXPECT_TRUE(fs::is_directory(taken));
  EXPECT_EQ(files(), 1);
}

TEST_F(FilesTest, NpyOfFloatsSaysSo) {
  const std::vector<float> values = {1.5f, NAN};
  write_npy(folder_ / "a.npy", values, 1, 2);
  const std::string bytes = read_file(folder_ / "a.npy");
  EXPECT_NE(bytes.find("'descr': '<f4'"), std::string::npos);
  EXPECT_EQ(std::memcmp(bytes.data() + bytes.size() - 8, values.data(), 8), 0);
}

}  // namespace
}  // namespace saker::core
