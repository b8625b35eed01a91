#include "tools/saker/report/html_page.h"

#include <gtest/gtest.h>

#include "saker/core/error.h"

namespace saker::tools {
namespace {

bool has(const std::string& text, const std::string& what) {
  return text.find(what) != std::string::npos;
}

TEST(HtmlPage, TextsAreEscapedWhereverTheyStand) {
  HtmlPage page("<a>");
  page.heading("b & c");
  page.paragraph("\"d\"");
  page.preformatted("1 < 2\n3\x01");
  page.table({"<h>"}, {{"<i>"}});
  const std::string text = page.text();
  EXPECT_TRUE(has(text, "<title>&lt;a&gt;</title>"));
  EXPECT_TRUE(has(text, "<h2>b &amp; c</h2>"));
  EXPECT_TRUE(has(text, "<p>&quot;d&quot;</p>"));
  EXPECT_TRUE(has(text, "<pre>1 &lt; 2\n3</pre>"));
  EXPECT_TRUE(has(text, "<th>&lt;h&gt;</th>"));
  EXPECT_TRUE(has(text, "<td>&lt;i&gt;</td>"));
}

TEST(HtmlPage, ATableWithoutRowsIsNone) {
  HtmlPage page("t");
  page.table({"a"}, {});
  EXPECT_FALSE(has(page.text(), "<table>"));
}

TEST(HtmlPage, PicturesKeepTheirClippingApart) {
  HtmlPage page("t");
  const std::string svg =
      "<?xml version=\"1.0\"?>\n<svg><clipPath id=\"view\"/><g clip-path=\"url(#view)\"/></svg>";
  page.picture(svg, "first");
  page.picture(svg, "second");
  const std::string text = page.text();
  EXPECT_FALSE(has(text, "<?xml"));
  EXPECT_FALSE(has(text, "\"view\""));
  for (const std::string id : {"view1", "view2"}) {
    EXPECT_TRUE(has(text, "id=\"" + id + "\""));
    EXPECT_TRUE(has(text, "url(#" + id + ")"));
  }
}

TEST(HtmlPage, WhatIsNoPictureIsRefused) {
  HtmlPage page("t");
  EXPECT_THROW(page.picture("no picture", "x"), Error);
}

TEST(HtmlPage, NeedsNoOtherFile) {
  const std::string text = HtmlPage("t").text();
  for (const char* loads : {"<script", "<link", "src=", "@import"}) EXPECT_FALSE(has(text, loads));
}

}  // namespace
}  // namespace saker::tools
