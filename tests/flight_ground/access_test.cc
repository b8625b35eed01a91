#include "flight/ground/access.h"

#include <gtest/gtest.h>

#include "flight_viewers/scratch_folder.h"
#include "saker/core/error.h"
#include "saker/core/files.h"

namespace saker::flight::ground {
namespace {

namespace fs = std::filesystem;
using testing::ScratchFolder;

constexpr const char* kKey = "0123456789abcdef";

TEST(Gate, OnThisMachineProgramsAndItsOwnPagesMayWithoutAKey) {
  const Gate gate("", true);
  EXPECT_TRUE(gate.admits({"127.0.0.1:8765", "", ""}));
  EXPECT_TRUE(gate.admits({"localhost:8765", "http://localhost:8765", ""}));
  EXPECT_TRUE(gate.admits({"127.0.0.1:8765", "http://127.0.0.1:8080", ""}));
  EXPECT_TRUE(gate.admits({"[::1]:8765", "file://", ""}));
}

TEST(Gate, APageOfAnotherSiteInItsBrowserMayNot) {
  const Gate gate("", true);
  EXPECT_FALSE(gate.admits({"127.0.0.1:8765", "https://evil.example", ""}));
  EXPECT_FALSE(gate.admits({"127.0.0.1:8765", "http://localhost.evil.example", ""}));
  EXPECT_FALSE(gate.admits({"127.0.0.1:8765", "null", ""}));
  EXPECT_FALSE(gate.admits({"evil.example:8765", "http://evil.example:8765", ""}));  // rebound
  EXPECT_FALSE(gate.admits({"", "", ""}));
  EXPECT_FALSE(gate.admits({"127.0.0.1:8765", "https://evil.example", "guess"}));
}

TEST(Gate, ForOtherMachinesTheKeyIsAllThatCounts) {
  const Gate gate(kKey, false);
  EXPECT_TRUE(gate.admits({"10.0.0.1:8765", "https://app.foxglove.dev", kKey}));
  EXPECT_FALSE(gate.admits({"10.0.0.1:8765", "https://10.0.0.1:8765", ""}));
  EXPECT_FALSE(gate.admits({"127.0.0.1:8765", "", ""}));
  EXPECT_FALSE(gate.admits({"127.0.0.1:8765", "", std::string(kKey) + "0"}));
  EXPECT_FALSE(gate.admits({"127.0.0.1:8765", "", "0123456789abcdeF"}));
}

struct PageTest : ::testing::Test {
  PageTest() {
    fs::create_directories(page / "vendor");
    core::write_file(page / "index.html", "<html>");
    core::write_file(page / "vendor/three.js", "//");
    core::write_file(page / ".hidden.js", "//");
    core::write_file(page / "secret.key", "0");
    core::write_file(scratch / "outside.js", "//");
    fs::create_symlink(scratch / "outside.js", page / "link.js");
  }

  ScratchFolder scratch;
  fs::path page = scratch / "page";
};

TEST_F(PageTest, ItsFilesAreServed) {
  EXPECT_EQ(page_file(page, "/"), fs::canonical(page / "index.html"));
  EXPECT_EQ(page_file(page, "/vendor/three.js"), fs::canonical(page / "vendor/three.js"));
  EXPECT_STREQ(media_type("a.js"), "text/javascript; charset=utf-8");
}

TEST_F(PageTest, NothingElseIs) {
  for (const std::string path :
       {"", "index.html", "/..", "/../outside.js", "/vendor/../../outside.js", "//etc/passwd",
        "/vendor", "/vendor/", "/none.js", "/.hidden.js", "/secret.key", "/link.js",
        "/./index.html"})
    EXPECT_EQ(page_file(page, path), std::nullopt) << path;
  EXPECT_EQ(page_file(page, std::string("/index.html\0.js", 15)), std::nullopt);
}

TEST(Credentials, AreDrawnOnceAndAreTheirOwnersAlone) {
  const ScratchFolder scratch;
  const Credentials first = credentials(scratch / "ground", "127.0.0.1");
  EXPECT_EQ(first.key.size(), 32u);
  EXPECT_EQ(first.fingerprint.size(), 95u);  // 32 bytes with colons between
  const Credentials second = credentials(scratch / "ground", "127.0.0.1");
  EXPECT_EQ(second.key, first.key);
  EXPECT_EQ(second.fingerprint, first.fingerprint);
  const Credentials other = credentials(scratch / "ground", "ground.local");
  EXPECT_EQ(other.key, first.key);
  EXPECT_NE(other.fingerprint, first.fingerprint);
  for (const fs::path& file : {first.private_key, scratch / "ground/address.key"}) {
    const auto others = fs::perms::group_all | fs::perms::others_all;
    EXPECT_EQ(fs::status(file).permissions() & others, fs::perms::none) << file;
  }
}

TEST(Credentials, AKeyThatIsTooShortIsRefused) {
  const ScratchFolder scratch;
  fs::create_directories(scratch / "ground");
  core::write_file(scratch / "ground/address.key", "short\n");
  EXPECT_THROW(credentials(scratch / "ground", "127.0.0.1"), Error);
}

}  // namespace
}  // namespace saker::flight::ground
