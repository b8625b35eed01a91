#include "saker/core/config_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "saker/core/error.h"
#include "saker/core/files.h"

namespace saker::core {
namespace {

namespace fs = std::filesystem;

class ConfigFolder : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_ / "models");
    write_file(folder_ / "models/a.yaml", "a");
    setenv("SAKER_CONFIG_DIR", folder_.c_str(), 1);
  }
  void TearDown() override {
    unsetenv("SAKER_CONFIG_DIR");
    fs::remove_all(folder_);
  }

  /// One a test: tests run side by side.
  fs::path folder_ =
      fs::path(testing::TempDir()) /
      (std::string("saker_") + testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(ConfigFolder, AFileIsFoundAsGivenOrInTheFolder) {
  EXPECT_EQ(find_in_configs("models/a.yaml", "key"), folder_ / "models/a.yaml");
  EXPECT_EQ(find_in_configs(folder_ / "models/a.yaml", "key"), folder_ / "models/a.yaml");
}

TEST_F(ConfigFolder, WhatIsMissingIsNamedWithKeyAndPlaces) {
  try {
    (void)find_in_configs("models/none.yaml", "stage.model");
    FAIL() << "no error";
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("stage.model: no such file: looked for models/none.yaml"),
              std::string::npos);
    EXPECT_NE(text.find((folder_ / "models/none.yaml").string()), std::string::npos);
  }
}

}  // namespace
}  // namespace saker::core
