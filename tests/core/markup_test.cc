#include "saker/core/markup.h"

#include <gtest/gtest.h>

namespace saker::core {
namespace {

TEST(Markup, WhatWouldBeATagOrEndAQuoteIsText) {
  EXPECT_EQ(escaped_markup("<a href=\"b&c\">"), "&lt;a href=&quot;b&amp;c&quot;&gt;");
}

TEST(Markup, ControlCharactersAreLeftOut) {
  const std::string_view text("a\0b\x1b\x07 c\n\td", 10);
  EXPECT_EQ(escaped_markup(text), "ab cd");
  EXPECT_EQ(escaped_markup(text, true), "ab c\n\td");
}

TEST(Markup, LettersOfAnyLanguageStay) { EXPECT_EQ(escaped_markup("Bäume 树"), "Bäume 树"); }

}  // namespace
}  // namespace saker::core
