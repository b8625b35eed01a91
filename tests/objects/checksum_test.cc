#include "saker/objects/checksum.h"

#include <gtest/gtest.h>

#include <string>

namespace saker::objects {
namespace {

TEST(Checksum, IsTheOneOfZipFiles) {
  EXPECT_EQ(checksum("123456789"), 0xCBF43926U);  // the check value that catalogues of CRCs list
  EXPECT_EQ(checksum(std::string(32, '\0')), 0x190A55ADU);
}

TEST(Checksum, OfNothingIsZero) {
  EXPECT_EQ(checksum({}), 0U);
  EXPECT_EQ(checksum(""), 0U);
}

TEST(Checksum, ChangesWithAnyBitOfABlock) {
  std::string block(64, 'x');
  const std::uint32_t before = checksum(block);
  for (char& byte : block) {
    for (int bit = 0; bit < 8; ++bit) {
      byte = static_cast<char>(byte ^ (1 << bit));
      EXPECT_NE(checksum(block), before);
      byte = static_cast<char>(byte ^ (1 << bit));
    }
  }
}

}  // namespace
}  // namespace saker::objects
