#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "flight/base_station/sealed.h"

namespace saker::flight {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::int64_t kNow = 1'800'000'000'000'000;  // us
constexpr double kMostAge = 2;                        // s

class AnOrder : public testing::Test {
 protected:
  void SetUp() override {
    std::string form = (std::filesystem::temp_directory_path() / "saker_order_XXXXXX").string();
    ASSERT_NE(mkdtemp(form.data()), nullptr);
    folder = form;
    key.fill(3);
    sealer = std::make_unique<exchange::Sealer>(key, "GROUND", folder / "counter");
    opener = std::make_unique<exchange::Opener>(key, "BASE", folder / "window");
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  [[nodiscard]] Bytes sealed(std::int64_t utime) const {
    const auto text = sealed_order(*sealer, "R1_COMMAND", utime, message);
    return {text->begin(), text->end()};
  }
  [[nodiscard]] std::optional<Bytes> opened(const Bytes& bytes,
                                            const std::string& channel = "R1_COMMAND") const {
    return opened_order(*opener, channel, bytes, kNow, kMostAge);
  }

  const Bytes message = {1, 0, 255, 7};
  std::filesystem::path folder;
  exchange::Key key{};
  std::unique_ptr<exchange::Sealer> sealer;
  std::unique_ptr<exchange::Opener> opener;
};

TEST_F(AnOrder, ComesOutAsItWentIn) { EXPECT_EQ(opened(sealed(kNow - 100'000)), message); }

TEST_F(AnOrder, IsGivenOutOnce) {
  const Bytes bytes = sealed(kNow);
  EXPECT_TRUE(opened(bytes));
  EXPECT_FALSE(opened(bytes));
}

TEST_F(AnOrder, ThatWasHeldBackIsNotObeyed) {
  EXPECT_FALSE(opened(sealed(kNow - 2'100'000)));
  EXPECT_FALSE(opened(sealed(kNow + 2'100'000)));
  EXPECT_TRUE(opened(sealed(kNow - 1'900'000)));
}

TEST_F(AnOrder, ForOneRobotIsNoneForAnother) { EXPECT_FALSE(opened(sealed(kNow), "R2_COMMAND")); }

TEST_F(AnOrder, WithoutATimeIsNone) {
  const auto text = sealer->seal("R1_COMMAND", "short");
  EXPECT_FALSE(opened({text->begin(), text->end()}));
}

TEST_F(AnOrder, CutAnywhereIsNone) {
  const Bytes bytes = sealed(kNow);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(opened({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)}));
}

}  // namespace
}  // namespace saker::flight
