#include "saker/objects/checksum.h"

#include <gtest/gtest.h>

#include <string>

#include "saker/core/rng.h"

namespace saker::objects {
namespace {

/// The check value of the catalogue of parametrised CRC algorithms (CRC-32/ISO-HDLC), and others
/// that zlib gives.
TEST(Checksum, IsThatOfZipFiles) {
  EXPECT_EQ(checksum("123456789"), 0xCBF43926U);
  EXPECT_EQ(checksum(""), 0U);
  EXPECT_EQ(checksum("a"), 0xE8B7BE43U);
  EXPECT_EQ(checksum(std::string(32, '\0')), 0x190A55ADU);
  EXPECT_EQ(checksum(std::string(32, '\xFF')), 0xFF6CAB0BU);
}

TEST(Checksum, NoticesEveryFlippedBit) {
  std::string bytes;
  core::Rng rng(1);
  for (int i = 0; i < 200; ++i) bytes += static_cast<char>(rng.index(256));
  const std::uint32_t before = checksum(bytes);
  for (std::size_t i = 0; i < 8 * bytes.size(); ++i) {
    bytes[i / 8] = static_cast<char>(bytes[i / 8] ^ (1 << i % 8));
    EXPECT_NE(checksum(bytes), before) << i;
    bytes[i / 8] = static_cast<char>(bytes[i / 8] ^ (1 << i % 8));
  }
  EXPECT_EQ(checksum(bytes), before);
}

TEST(Checksum, NoticesTwoBytesThatChangePlacesAndAZeroMoreAtTheEnd) {
  EXPECT_NE(checksum("ab"), checksum("ba"));
  EXPECT_NE(checksum(std::string(4, '\0')), checksum(std::string(5, '\0')));
}

/// A burst of at most 32 bits never passes unnoticed (Peterson and Brown, Proc. IRE 1961).
TEST(Checksum, NoticesEveryBurstOfFourBytes) {
  core::Rng rng(2);
  const std::string bytes(1000, 'x');
  for (int i = 0; i < 2000; ++i) {
    std::string damaged = bytes;
    const int at = rng.index(996);
    for (int k = 0; k < 4; ++k)
      damaged[static_cast<std::size_t>(at + k)] = static_cast<char>(rng.index(256));
    if (damaged != bytes) {
      EXPECT_NE(checksum(damaged), checksum(bytes));
    }
  }
}

}  // namespace
}  // namespace saker::objects
