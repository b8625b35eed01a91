#include "saker/exchange/durable.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "saker/core/files.h"
#include "two_ends.h"

namespace saker::exchange {
namespace {

TEST(WriteDurably, ReplacesTheWholeFileAndLeavesNothingElse) {
  const auto folder = test_folder();
  const auto file = folder / "f";
  EXPECT_TRUE(write_durably(file, some_bytes(3000, 1)));
  EXPECT_TRUE(write_durably(file, "short"));
  EXPECT_EQ(core::read_file(file), "short");
  EXPECT_TRUE(write_durably(file, ""));
  EXPECT_EQ(core::read_file(file), "");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
}

TEST(WriteDurably, IsReadableByItsOwnerOnly) {
  const auto file = test_folder() / "f";
  ASSERT_TRUE(write_durably(file, "secret"));
  struct stat status {};
  ASSERT_EQ(::stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600u);
}

TEST(WriteDurably, KeepsWhoMayReadWhatItReplacesButNeverEverybody) {
  const auto file = test_folder() / "f";
  struct stat status {};
  for (const mode_t mode : {0640, 0664, 0600}) {
    core::write_file(file, "before");
    ASSERT_EQ(::chmod(file.c_str(), mode), 0);
    ASSERT_TRUE(write_durably(file, "after", Access::kept));
    ASSERT_EQ(::stat(file.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, mode & 0770);
    EXPECT_EQ(core::read_file(file), "after");
  }
  std::filesystem::remove(file);
  ASSERT_TRUE(write_durably(file, "new", Access::kept));
  ASSERT_EQ(::stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600u);
}

TEST(WriteDurably, SaysWhereItCouldNotAndKeepsWhatWasThere) {
  const auto folder = test_folder();
  EXPECT_FALSE(write_durably(folder / "none" / "f", "x"));
  std::filesystem::create_directories(folder / "taken" / "by");
  EXPECT_FALSE(write_durably(folder / "taken", "x"));
  EXPECT_TRUE(std::filesystem::is_directory(folder / "taken" / "by"));
}

TEST(WriteAt, WritesAtItsPlaceAndNowhereElse) {
  const auto file = test_folder() / "f";
  core::write_file(file, "0123456789");
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_GE(descriptor, 0);
  EXPECT_TRUE(write_at(descriptor, "ab", 3));
  EXPECT_TRUE(write_at(descriptor, "", 5));
  EXPECT_TRUE(write_at(descriptor, "end", 12));
  ::close(descriptor);
  EXPECT_EQ(core::read_file(file), std::string("012ab56789\0\0end", 15));
}

TEST(WriteAt, SaysWhereItCouldNot) {
  const auto file = test_folder() / "f";
  core::write_file(file, "x");
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_GE(descriptor, 0);
  EXPECT_FALSE(write_at(descriptor, "ab", 0));
  ::close(descriptor);
  EXPECT_FALSE(write_at(descriptor, "ab", 0)) << "closed";
  EXPECT_EQ(core::read_file(file), "x");
}

}  // namespace
}  // namespace saker::exchange
