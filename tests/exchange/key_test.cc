#include "saker/exchange/key.h"

#include <gtest/gtest.h>

#include "saker/core/error.h"
#include "saker/core/files.h"
#include "two_ends.h"

namespace saker::exchange {
namespace {

using std::filesystem::perms;

/// The message of the Error that reading the file ends in; empty where there is none.
std::string fault_of(const std::filesystem::path& file) {
  try {
    (void)read_key(file);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(KeyFile, IsReadAsItWasMade) {
  const auto folder = test_folder();
  make_key_file(folder / "a");
  make_key_file(folder / "b");
  EXPECT_EQ(read_key(folder / "a"), read_key(folder / "a"));
  EXPECT_NE(read_key(folder / "a"), read_key(folder / "b"));
}

TEST(KeyFile, IsReadableByItsOwnerOnly) {
  const auto file = test_folder() / "key";
  make_key_file(file);
  EXPECT_EQ(std::filesystem::status(file).permissions(), perms::owner_read | perms::owner_write);
}

TEST(KeyFile, AnExistingOneIsNotReplaced) {
  const auto file = test_folder() / "key";
  make_key_file(file);
  const Key key = read_key(file);
  EXPECT_THROW(make_key_file(file), Error);
  EXPECT_EQ(read_key(file), key);
}

TEST(KeyFile, OneThatEverybodyMayReadIsRefusedWithTheCommandThatMendsIt) {
  const auto file = test_folder() / "key";
  make_key_file(file);
  std::filesystem::permissions(file, perms::group_read | perms::others_read,
                               std::filesystem::perm_options::add);
  EXPECT_NE(fault_of(file).find("(mode 0644), mend with: chmod o-rwx"), std::string::npos);
  std::filesystem::permissions(file, perms::others_read, std::filesystem::perm_options::remove);
  EXPECT_EQ(fault_of(file), "");
}

TEST(KeyFile, WhatIsNoKeyIsRefused) {
  const auto file = test_folder() / "key";
  for (const std::string& text : {std::string(), std::string(63, 'a'), std::string(66, 'a'),
                                  std::string(64, 'g'), std::string(62, 'a') + " a"}) {
    core::write_file(file, text);
    std::filesystem::permissions(file, perms::owner_read | perms::owner_write);
    EXPECT_NE(fault_of(file).find("expected 64 hexadecimal digits"), std::string::npos) << text;
  }
  EXPECT_NE(fault_of(test_folder() / "none").find("cannot read"), std::string::npos);
}

}  // namespace
}  // namespace saker::exchange
