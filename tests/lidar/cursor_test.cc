#include "saker/lidar/cursor.h"

#include <gtest/gtest.h>

#include <vector>

#include "made_bag.h"
#include "made_sensor.h"
#include "saker/core/error.h"
#include "saker/lidar/file_bytes.h"

namespace saker::lidar {
namespace {

using Bytes = std::vector<std::uint8_t>;

TEST(Cursor, ReadsNumbersInEitherOrderOfBytes) {
  const Bytes bytes = {1, 2, 3, 4, 0, 0, 0x80, 0x3F};
  Cursor little(bytes), big(bytes, true);
  EXPECT_EQ(little.number<std::uint32_t>(), 0x04030201U);
  EXPECT_EQ(little.number<float>(), 1.0F);
  EXPECT_EQ(big.number<std::uint16_t>(), 0x0102);
  EXPECT_EQ(big.number<std::int16_t>(), 0x0304);
}

TEST(Cursor, PastTheEndGivesZeroAndFailsForGood) {
  const Bytes bytes = {1, 2, 3};
  Cursor cursor(bytes);
  EXPECT_EQ(cursor.number<std::uint32_t>(), 0U);
  EXPECT_FALSE(cursor.ok());
  EXPECT_EQ(cursor.number<std::uint8_t>(), 1);  // what is there is still read
  EXPECT_FALSE(cursor.ok());
  EXPECT_EQ(cursor.left(), 2U);
}

TEST(Cursor, TakesAtMostWhatThereIs) {
  const Bytes bytes = {1, 2, 3};
  Cursor cursor(bytes);
  EXPECT_EQ(cursor.take_at_most(100).size(), 3U);
  EXPECT_TRUE(cursor.ok());
  EXPECT_TRUE(cursor.take(~std::size_t{0}).empty());
  EXPECT_FALSE(cursor.ok());
}

TEST(Cursor, AlignsFromTheBeginning) {
  const Bytes bytes(20, 0);
  Cursor cursor(bytes);
  cursor.align(8);
  EXPECT_EQ(cursor.at(), 0U);
  cursor.skip(1);
  cursor.align(8);
  EXPECT_EQ(cursor.at(), 8U);
}

TEST(FileBytes, AreReadAnywhereAndFewerAtTheEnd) {
  const testing::TemporaryFolder folder;
  testing::write_bytes(folder / "a", {1, 2, 3, 4, 5});
  const FileBytes file(folder / "a");
  EXPECT_EQ(file.size(), 5U);
  Bytes bytes;
  file.read(1, 2, bytes);
  EXPECT_EQ(bytes, (Bytes{2, 3}));
  file.read(4, ~std::size_t{0}, bytes);
  EXPECT_EQ(bytes, Bytes{5});
  file.read(~std::uint64_t{0}, 1, bytes);
  EXPECT_TRUE(bytes.empty());
}

TEST(FileBytes, OfAFolderOrOfNothingAreRefused) {
  const testing::TemporaryFolder folder;
  EXPECT_THROW(FileBytes(folder.path()), Error);
  EXPECT_THROW(FileBytes(folder / "missing"), Error);
}

}  // namespace
}  // namespace saker::lidar
