#include <gtest/gtest.h>

#include "made_clouds.h"
#include "saker/lidar/clouds/cloud_file.h"

namespace saker::lidar {
namespace {

using testing::npy_of;
using testing::put;
using Bytes = std::vector<std::uint8_t>;

/// What a head of two points makes of their bytes: "x y z" and the step, or the fault.
std::string read(const std::string& descr, std::size_t bytes = 400) {
  Cloud cloud;
  const std::string fault = parse_npy(npy_of(descr, "2,", Bytes(bytes, 0)), cloud);
  if (!fault.empty()) return fault;
  return cloud.layout.names() + " " + std::to_string(cloud.layout.step);
}

TEST(NpyFile, OfBigEndianRecordsWithNumbersOfOneByteIsRead) {
  Bytes data;
  for (const float value : {1.0F, 2.0F, 3.0F}) put(data, value, true);
  data.push_back(7);
  Cloud cloud;
  ASSERT_EQ(
      parse_npy(npy_of("[('x', '>f4'), ('y', '>f4'), ('z', '>f4'), ('ring', '|u1')]", "1,", data),
                cloud),
      "");
  Scan scan;
  PointReader reader(cloud.layout, "made");
  ASSERT_EQ(reader.read(cloud.bytes, 1, 1, 13, 0, scan), "");
  EXPECT_EQ(scan.points[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(scan.ring[0], 7);
}

TEST(NpyFile, OfBothOrdersOfBytesIsRefusedByTheField) {
  EXPECT_EQ(read("[('x', '<f4'), ('y', '>f4'), ('z', '<f4')]"),
            "field y: numbers of several orders of bytes");
}

TEST(NpyFile, FieldsOfSeveralNumbersAndBytesBetweenFieldsHaveTheirRoom) {
  EXPECT_EQ(read("[('x', '<f4'), ('d', '<u2', (3,)), ('y', '<f4'), ('z', '<f4')]"),
            "x d d_1 d_2 y z 18");
  EXPECT_EQ(read("[('x', '<f4'), ('', '|V4'), ('y', '<f4'), ('z', '<f4')]"), "x y z 16");
  EXPECT_NE(read("[('x', '<f4', (3, 3)), ('y', '<f4')]").find("field x"), std::string::npos);
}

TEST(NpyFile, MayBeWrittenWithOtherQuotesAndSpaces) {
  EXPECT_EQ(read("[ (\"x\",\"<f4\"),('y' , '=f4'),( 'z','<f8' ) ]"), "x y z 16");
}

TEST(NpyFile, TypesThatAreNoNumbersAreRefusedByTheirName) {
  for (const char* type : {"<c8", "|S4", "<M8[ns]", "|b1", "<", "", "f4"}) {
    const std::string fault = read("[('x', '" + std::string(type) + "')]");
    EXPECT_NE(fault.find("field x: type " + std::string(type)), std::string::npos) << fault;
  }
}

TEST(NpyFile, HeadsThatAreNoneAreRefusedWhateverTheirLength) {
  for (const std::string open : {"'", "[", "[(", "[('x'", "[('x', ", "[('x', '<f4', (", "{", ""}) {
    EXPECT_NE(read(open), "");
    EXPECT_NE(read(open + std::string(60'000, ' ')), "");
    EXPECT_NE(read(open + std::string(60'000, 'a')), "");
    EXPECT_NE(read(open + std::string(60'000, '(')), "");
  }
}

TEST(NpyFile, OfAShapeThatItsBytesCannotHoldIsRefused) {
  Cloud cloud;
  for (const char* shape :
       {"20000000, 4", "20000000, 20000000, 4", "-1, 4", "0, 4", "4", "", "a"}) {
    EXPECT_NE(parse_npy(npy_of("'<f4'", shape, Bytes(64, 1)), cloud), "") << shape;
  }
}

}  // namespace
}  // namespace saker::lidar
