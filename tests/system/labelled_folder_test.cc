#include "tools/saker/evaluate/labelled_folder.h"

#include <gtest/gtest.h>

#include "saker/core/error.h"
#include "saker/core/files.h"

namespace saker::tools {
namespace {

namespace fs = std::filesystem;

class LabelledFolderTest : public testing::Test {
 protected:
  LabelledFolderTest()
      : folder_(fs::path(testing::TempDir()) /
                (std::string("saker_") +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "labels");
  }
  ~LabelledFolderTest() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& content) const {
    core::write_file(folder_ / name, content);
  }
  /// The one line that says why, or nothing.
  [[nodiscard]] std::string complaint() const {
    try {
      const LabelledFolder folder(folder_);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  fs::path folder_;
};

TEST_F(LabelledFolderTest, IdsAreTheLowerBitsOfTheLabels) {
  write("labels/000001.label", std::string("\x0a\0\x07\0\x28\0\0\0", 8));
  EXPECT_EQ(LabelledFolder(folder_).ids("000001", 2), (std::vector<std::uint32_t>{10, 40}));
}

TEST_F(LabelledFolderTest, AScanWithoutAFileHasNoIds) {
  write("labels/000001.label", std::string(4, '\0'));
  EXPECT_EQ(LabelledFolder(folder_).ids("000002", 1), std::nullopt);
}

TEST_F(LabelledFolderTest, LabelsOfAnotherLengthAreAnError) {
  write("labels/000001.label", std::string(8, '\0'));
  EXPECT_THROW((void)LabelledFolder(folder_).ids("000001", 3), Error);
}

TEST_F(LabelledFolderTest, BoxesAreThoseOfVehiclesWithTheirIdentity) {
  write("boxes.json", R"({"a": [
    {"class": "Car", "position": [1, 2, 3], "size": [4, 2, 1], "yaw": 0.5, "id": 7},
    {"class": "Pedestrian", "position": [1, 2, 3], "size": [1, 1, 2], "yaw": 0}]})");
  const LabelledFolder folder(folder_);
  ASSERT_EQ(folder.boxes("a")->size(), 1U);
  EXPECT_EQ(folder.boxes("a")->front().vehicle, "7");
  EXPECT_EQ(folder.boxes("a")->front().kind, "car");
  EXPECT_EQ(folder.boxes("b"), nullptr);
}

TEST_F(LabelledFolderTest, AFieldOfViewHoldsForTheScansThatItNames) {
  write("boxes.json", R"({"a": [], "b": []})");
  write("field_of_view.json", R"({"a": "camera"})");
  const LabelledFolder folder(folder_);
  EXPECT_EQ(folder.half_angle_deg("a"), 40.0F);
  EXPECT_EQ(folder.half_angle_deg("b"), std::nullopt);
}

TEST_F(LabelledFolderTest, AHalfAngleHoldsForAllScans) {
  write("boxes.json", R"({"a": []})");
  write("field_of_view.json", R"({"half_angle_deg": 30})");
  EXPECT_EQ(LabelledFolder(folder_).half_angle_deg("a"), 30.0F);
}

TEST_F(LabelledFolderTest, WhatIsWrongInBoxesIsNamed) {
  write("boxes.json", R"({"a": [{"class": "Car", "position": [1, 2], "size": [4, 2, 1]}]})");
  EXPECT_NE(complaint().find("boxes.json a[0].position: [1,2], expected 3 numbers"),
            std::string::npos)
      << complaint();
}

TEST_F(LabelledFolderTest, AFolderWithoutLabelsIsAnError) {
  EXPECT_NE(complaint().find("nothing is labelled"), std::string::npos) << complaint();
}

}  // namespace
}  // namespace saker::tools
