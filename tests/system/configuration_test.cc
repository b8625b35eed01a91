#include "tools/saker/configuration.h"

#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <sstream>

#include "flight/process/old_keys.h"
#include "flight/process/presets.h"
#include "paths.h"
#include "saker/core/config_io.h"
#include "saker/core/error.h"
#include "saker/core/files.h"

namespace saker::tools {
namespace {

const flight::ProcessConfig kDefaults;

TEST(Configuration, TheFileInTheRepositoryIsTheOneOfTheProgram) {
  const std::filesystem::path written = std::filesystem::path(testing::TempDir()) / "default.yaml";
  core::write_file(written, settings_text(kDefaults));
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
  common.configuration = {
      .preset = "paper", .file = file.string(), .settings = {"rates.slam_hz=1"}};
  const autonomy::Config config = read_configuration(common).autonomy;
  EXPECT_EQ(config.rates.slam_hz, 1);
  EXPECT_EQ(config.rates.segmentation_hz, 8);
  EXPECT_EQ(config.active.policy, active::PolicyName::paper);
}

TEST(Configuration, TheBestIsTheDefault) {
  EXPECT_EQ(kDefaults.autonomy.active.policy, active::PolicyName::saker);
  EXPECT_EQ(kDefaults.autonomy.slam.measurement_noise, slam::NoiseSource::fitted);
}

TEST(Configuration, EachPresetIsAVariantOfTheDefaultsWithinTheirBounds) {
  for (const flight::Preset& preset : flight::presets()) {
    const flight::ProcessConfig variant = flight::with_preset(preset.name);
    EXPECT_NO_THROW((void)core::checked(variant, preset.name));
    EXPECT_NE(configuration_text(variant), configuration_text(kDefaults)) << preset.name;
  }
  EXPECT_THROW((void)flight::with_preset("papper"), Error);
}

/// What the log says while a configuration is read, a line each.
std::vector<std::string> said(const std::string& file, const std::vector<std::string>& settings) {
  std::ostringstream text;
  const auto before = spdlog::default_logger();
  auto logger = std::make_shared<spdlog::logger>(
      "test", std::make_shared<spdlog::sinks::ostream_sink_mt>(text));
  logger->set_pattern("%l %v");
  spdlog::set_default_logger(logger);
  CommonOptions common;
  common.configuration = {.preset = {}, .file = file, .settings = settings};
  check_configuration(common);
  (void)read_configuration(common);  // says nothing again
  spdlog::set_default_logger(before);
  std::vector<std::string> lines;
  std::istringstream in(text.str());
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// Keys in a file that hold a value, "a.b.c".
std::vector<std::string> values_of(const YAML::Node& node, const std::string& key = "") {
  if (!node.IsMap()) return {key};
  std::vector<std::string> keys;
  for (const auto& entry : node) {
    const std::string inner = (key.empty() ? "" : key + ".") + entry.first.Scalar();
    for (std::string& value : values_of(entry.second, inner)) keys.push_back(std::move(value));
  }
  return keys;
}

TEST(OldConfiguration, IsReadWithALineForEachKeyThatMovedOrWent) {
  const std::string file = source_dir() + "/tests/system/old_default.yaml";
  const std::vector<std::string> lines = said(file, {});
  const std::vector<std::string> known = core::config_keys(kDefaults);
  std::size_t missing = 0;
  for (const std::string& key : values_of(YAML::LoadFile(file))) {
    if (std::ranges::find(known, key) != known.end()) continue;
    ++missing;
    const auto names_it = [&](const std::string& line) {
      return line.starts_with("warning " + file + ": " + key + ": is ");
    };
    EXPECT_EQ(std::ranges::count_if(lines, names_it), 1) << key;
  }
  EXPECT_GT(missing, 60U);
  EXPECT_EQ(lines.size(), missing);
}

TEST(OldConfiguration, OfAnInstalledRobotIsReadWithoutAWord) {
  const std::string file = source_dir() + "/tests/system/old_installed.yaml";
  EXPECT_EQ(said(file, {}), std::vector<std::string>{});
  CommonOptions common;
  common.configuration.file = file;
  EXPECT_EQ(read_configuration(common).autonomy.motion.geofence.highest_m, 6);
}

TEST(OldConfiguration, AMovedKeyIsApplied) {
  const std::vector<std::string> settings = {"slam.merge.loop_every=7"};
  EXPECT_EQ(said("", settings), std::vector<std::string>{
                                    "warning --set slam.merge.loop_every=7: slam.merge.loop_every: "
                                    "is now multirobot.loop_every"});
  CommonOptions common;
  common.configuration.settings = settings;
  EXPECT_EQ(read_configuration(common).autonomy.multirobot.loop_every, 7);
}

TEST(OldConfiguration, EveryNewPlaceIsAKeyAndNoOldOneIs) {
  const std::vector<std::string> known = core::config_keys(kDefaults);
  for (const core::MovedKey& key : flight::kOldKeys) {
    EXPECT_EQ(std::ranges::find(known, key.old_key), known.end()) << key.old_key;
    if (key.new_key == nullptr) {
      EXPECT_STRNE(key.why, "") << key.old_key;
    } else {
      EXPECT_NE(std::ranges::find(known, key.new_key), known.end()) << key.new_key;
    }
  }
}

}  // namespace
}  // namespace saker::tools
