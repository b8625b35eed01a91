#include "flight/ground/access.h"

#include <gtest/gtest.h>

#include <cctype>
#include <set>

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

TEST(Credentials, WhatAnEarlierStartLeftHalfWrittenIsDrawnAnew) {
  const ScratchFolder scratch;
  const Credentials whole = credentials(scratch / "ground", "127.0.0.1");
  for (const fs::path& file :
       {whole.certificate, whole.private_key, scratch / "ground/address.key"}) {
    fs::resize_file(file, 0);  // the power went while it was written
    const Credentials again = credentials(scratch / "ground", "127.0.0.1");
    EXPECT_EQ(again.key.size(), 32u) << file;
    EXPECT_EQ(again.fingerprint.size(), 95u) << file;
    EXPECT_GT(fs::file_size(file), 0u) << file;
  }
}

TEST(Credentials, ANewPrivateKeyHasANewCertificate) {
  const ScratchFolder scratch;
  const Credentials first = credentials(scratch / "ground", "127.0.0.1");
  fs::remove(first.private_key);
  EXPECT_NE(credentials(scratch / "ground", "127.0.0.1").fingerprint, first.fingerprint);
}

TEST(Credentials, NothingElseIsLeftInTheFolder) {
  const ScratchFolder scratch;
  static_cast<void>(credentials(scratch / "ground", "127.0.0.1"));
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(scratch / "ground"))
    names.insert(entry.path().filename());
  EXPECT_EQ(names, (std::set<std::string>{"address.key", "certificate-127.0.0.1.pem",
                                          "private-key-127.0.0.1.pem"}));
}

TEST(Credentials, AreThoseOfPem) {
  const ScratchFolder scratch;
  const Credentials drawn = credentials(scratch / "ground", "127.0.0.1");
  EXPECT_TRUE(core::read_file(drawn.certificate).starts_with("-----BEGIN CERTIFICATE-----\n"));
  EXPECT_TRUE(core::read_file(drawn.private_key).ends_with("-----END PRIVATE KEY-----\n"));
  for (const char c : drawn.key) EXPECT_TRUE(std::isxdigit(static_cast<unsigned char>(c))) << c;
}

TEST(Credentials, TwoFoldersHaveTwoKeys) {
  const ScratchFolder a, b;
  EXPECT_NE(credentials(a / "ground", "127.0.0.1").key, credentials(b / "ground", "127.0.0.1").key);
}

TEST(Credentials, APersonsOwnKeyIsTakenWithoutItsLineEnd) {
  const ScratchFolder scratch;
  fs::create_directories(scratch / "ground");
  core::write_file(scratch / "ground/address.key", "A-key_of-my-own-0123456789\r\n");
  EXPECT_EQ(credentials(scratch / "ground", "127.0.0.1").key, "A-key_of-my-own-0123456789");
}

TEST(Credentials, AKeyThatNoAddressCanHoldIsRefused) {
  const ScratchFolder scratch;
  fs::create_directories(scratch / "ground");
  for (const std::string& key :
       {std::string("with a blank in it"), std::string("ends&with=another"),
        std::string("two\nlines-of-letters"), std::string(201, 'a'),
        std::string("umlauts-\xc3\xbc-too-long")}) {
    core::write_file(scratch / "ground/address.key", key);
    EXPECT_THROW(credentials(scratch / "ground", "127.0.0.1"), Error) << key;
  }
}

TEST(Credentials, AFolderThatCannotBeMadeIsAnError) {
  const ScratchFolder scratch;
  core::write_file(scratch / "file", "");
  EXPECT_THROW(credentials(scratch / "file/ground", "127.0.0.1"), Error);
}

TEST(Credentials, AnAddressThatNoCertificateCanNameIsRefused) {
  const ScratchFolder scratch;
  EXPECT_THROW(credentials(scratch / "ground", "1.2.3.4.5"), Error);
}

TEST(ThisMachine, IsItsNamesWithOrWithoutAPort) {
  for (const char* host :
       {"localhost", "localhost:8765", "127.0.0.1", "127.0.0.1:1", "[::1]", "[::1]:8765"})
    EXPECT_TRUE(is_this_machine(host)) << host;
}

TEST(ThisMachine, IsNoNameThatBeginsOrEndsLikeIt) {
  for (const char* host :
       {"", ":", ":8765", "localhost.example", "localhost:8765.example", "notlocalhost",
        "127.0.0.1.example", "127.0.0.10", "127.0.0.1:80:80", "0.0.0.0", "::1", "[::1", "[::1]x",
        "[::2]", "localhost:8765/", "localhost@evil.example", "user@localhost", "evil.example:127"})
    EXPECT_FALSE(is_this_machine(host)) << host;
}

TEST(Gate, AnOriginIsItsSchemeAndHost) {
  const Gate gate("", true);
  for (const char* origin : {"https://localhost", "http://[::1]:3000"})
    EXPECT_TRUE(gate.admits({"localhost", origin, ""})) << origin;
  for (const char* origin :
       {"localhost", "ws://localhost", "ftp://127.0.0.1", "http://", "http:/localhost",
        "https://localhost.", "chrome-extension://abc", "unreadable"})
    EXPECT_FALSE(gate.admits({"localhost", origin, ""})) << origin;
}

TEST(Gate, WithoutAKeyForOtherMachinesNobodyMay) {
  const Gate gate("", false);
  EXPECT_FALSE(gate.admits({"localhost:8765", "", ""}));
}

TEST(Gate, OnThisMachineTheKeyOpensToAnyPage) {
  EXPECT_TRUE(Gate(kKey, true).admits({"evil.example", "https://evil.example", kKey}));
}

TEST(MediaType, IsKnownOfWhatPagesAreMadeOf) {
  EXPECT_STREQ(media_type("a.html"), "text/html; charset=utf-8");
  EXPECT_STREQ(media_type("a.b.css"), "text/css; charset=utf-8");
  EXPECT_STREQ(media_type("icon.svg"), "image/svg+xml");
  for (const char* name : {"a", "a.cc", "a.pem", "a.key", "js", ".js", "a.js.bak"})
    EXPECT_EQ(media_type(name), nullptr) << name;
}

TEST_F(PageTest, AFolderThatIsNotThereServesNothing) {
  EXPECT_EQ(page_file(scratch / "none", "/"), std::nullopt);
}

TEST_F(PageTest, ALinkWithinThePageIsServed) {
  fs::create_symlink(page / "vendor/three.js", page / "three.js");
  EXPECT_EQ(page_file(page, "/three.js"), fs::canonical(page / "vendor/three.js"));
}

TEST_F(PageTest, AFolderBesideItWithTheSameBeginningIsNotThePage) {
  fs::create_directories(scratch / "page2");
  core::write_file(scratch / "page2/a.js", "//");
  fs::create_symlink(scratch / "page2/a.js", page / "a.js");
  EXPECT_EQ(page_file(page, "/a.js"), std::nullopt);
}

TEST_F(PageTest, APathOfManyKilobytesIsNone) {
  EXPECT_EQ(page_file(page, "/" + std::string(70000, 'a') + ".js"), std::nullopt);
  std::string deep;
  for (int i = 0; i < 5000; ++i) deep += "/vendor";
  EXPECT_EQ(page_file(page, deep + "/three.js"), std::nullopt);
}

}  // namespace
}  // namespace saker::flight::ground
