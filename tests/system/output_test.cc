#include "flight/command_line/output.h"

#include <gtest/gtest.h>
#include <spdlog/spdlog.h>

#include <functional>

#include "saker/core/error.h"
#include "saker/core/files.h"

namespace saker::flight {
namespace {

namespace fs = std::filesystem;

class OutputTest : public testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::path(testing::TempDir()) /
            ("saker_output_" +
             std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(root_);
    fs::create_directories(root_);
    common_.out = (root_ / "a" / "out").string();
    start_logging(false);
  }
  void TearDown() override { fs::remove_all(root_); }

  std::string complaint() const {
    try {
      const OutputFolder out(common_);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  fs::path root_;
  CommonOptions common_;
};

TEST_F(OutputTest, TheFolderIsMadeAndHoldsTheLog) {
  {
    const OutputFolder out(common_);
    EXPECT_TRUE(fs::is_directory(out.folder("labels")));
    spdlog::warn("something");
  }
  const std::string log = core::read_file(fs::path(common_.out) / "log.txt");
  EXPECT_NE(log.find("something"), std::string::npos) << log;
}

TEST_F(OutputTest, ResultsAreNotReplacedUnlessForced) {
  { const OutputFolder out(common_); }
  EXPECT_EQ(complaint(), "") << "a log is not a result";
  core::write_file(fs::path(common_.out) / "map.json", "{}");
  EXPECT_EQ(complaint(),
            common_.out + " holds results: name another folder, or --force to replace them");
  common_.force = true;
  EXPECT_EQ(complaint(), "");
  EXPECT_TRUE(fs::exists(fs::path(common_.out) / "map.json"));
}

TEST_F(OutputTest, AFolderThatCannotBeMadeIsNamed) {
  core::write_file(root_ / "a", "a file");
  EXPECT_EQ(complaint(), "cannot make the folder " + common_.out + ": Not a directory");
  common_.out = (root_ / "a").string();
  EXPECT_EQ(complaint().substr(0, 23), "cannot make the folder ");
}

TEST_F(OutputTest, AFileIsNotReplacedUnlessForced) {
  const fs::path file = root_ / "view.png";
  EXPECT_EQ(output_file(file, false), file);
  core::write_file(file, "x");
  EXPECT_THROW((void)output_file(file, false), Error);
  EXPECT_EQ(output_file(file, true), file);
  EXPECT_THROW((void)output_file(root_, true), Error);
  EXPECT_THROW((void)output_file(root_ / "none" / "view.png", true), Error);
}

}  // namespace
}  // namespace saker::flight
