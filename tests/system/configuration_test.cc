#include "tools/saker/configuration.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "paths.h"
#include "saker/core/config_io.h"
#include "saker/core/error.h"
#include "saker/core/files.h"

namespace saker::tools {
namespace {

const flight::ProcessConfig kDefaults;

TEST(Configuration, TheFileInTheRepositoryIsTheOneOfTheProgram) {
  const std::filesystem::path written = std::filesystem::path(testing::TempDir()) / "default.yaml";
  core::write_file(written, configuration_text(kDefaults));
  EXPECT_TRUE(core::read_file(written) == core::read_file(source_dir() + "/configs/default.yaml"))
      << "compare configs/default.yaml with " << written;
}

TEST(Configuration, TheDefaultsAreWithinTheirBounds) {
  EXPECT_NO_THROW((void)core::checked(kDefaults, "saker"));
}

TEST(Configuration, WhatIsWrittenIsReadBackTheSame) {
  const std::string text = configuration_text(kDefaults);
  EXPECT_EQ(configuration_text(core::config_from_yaml(text, "default.yaml", kDefaults)), text);
}

TEST(Configuration, NoKeyIsListedTwice) {
  auto keys = core::config_keys(kDefaults);
  std::sort(keys.begin(), keys.end());
  EXPECT_EQ(std::adjacent_find(keys.begin(), keys.end()), keys.end());
  EXPECT_GT(keys.size(), 50u);
}

TEST(Configuration, TheNetworksOfTheProcessesAreInIt) {
  const auto keys = core::config_keys(kDefaults);
  EXPECT_NE(std::find(keys.begin(), keys.end(), "bus.control_url"), keys.end());
}

TEST(Configuration, SettingsComeAfterTheFile) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "set.yaml";
  core::write_file(file, "rates: {slam_hz: 4, segmentation_hz: 8}\n");
  CommonOptions common;
  common.config_file = file.string();
  common.settings = {"rates.slam_hz=1"};
  const autonomy::Config config = read_configuration(common).autonomy;
  EXPECT_EQ(config.rates.slam_hz, 1);
  EXPECT_EQ(config.rates.segmentation_hz, 8);
}

}  // namespace
}  // namespace saker::tools
