#include "tools/saker/report/changed_values.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "saker/core/config_io.h"

namespace saker::tools {
namespace {

flight::ProcessConfig with(const std::string& setting) {
  return core::config_with_setting(setting, flight::ProcessConfig{});
}

TEST(ChangedValues, OfTheDefaultsThereAreNone) { EXPECT_TRUE(changed_values({}).empty()); }

TEST(ChangedValues, AScalarIsSaidWithItsKeyAndItsDefault) {
  const auto changed = changed_values(with("ground.port=9000"));
  ASSERT_EQ(changed.size(), 1u);
  EXPECT_EQ(changed[0].key, "ground.port");
  EXPECT_EQ(changed[0].value, "9000");
  EXPECT_EQ(changed[0].normal, "8765");
}

TEST(ChangedValues, AListOfNumbersIsOneValue) {
  const auto changed = changed_values(with("site.origin=[47.5, 8.25, 30]"));
  ASSERT_EQ(changed.size(), 1u);
  EXPECT_EQ(changed[0].key, "site.origin");
  EXPECT_NE(changed[0].value.find("47.5"), std::string::npos);
  EXPECT_EQ(changed[0].normal, "[]");
}

TEST(ChangedValues, AnEntryOfAListOfGroupsHasItsNumber) {
  const auto changed = changed_values(with("objects.classes[1].length_sd_m=0.77"));
  ASSERT_EQ(changed.size(), 1u);
  EXPECT_EQ(changed[0].key, "objects.classes[1].length_sd_m");
  EXPECT_EQ(changed[0].value, "0.77");
}

TEST(ChangedValues, EntriesThatAListHasNoMoreAreSaidWithoutAValue) {
  flight::ProcessConfig config;
  const std::size_t classes = config.autonomy.objects.classes.size();
  config.autonomy.objects.classes.pop_back();
  const auto changed = changed_values(config);
  ASSERT_FALSE(changed.empty());
  for (const ChangedValue& value : changed) {
    EXPECT_EQ(value.key.find(fmt::format("objects.classes[{}].", classes - 1)), 0u) << value.key;
    EXPECT_EQ(value.value, "");
  }
}

}  // namespace
}  // namespace saker::tools
