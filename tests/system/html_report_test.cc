#include "tools/saker/report/html_report.h"

#include <gtest/gtest.h>

#include "flight_viewers/scratch_folder.h"
#include "saker/core/error.h"
#include "saker/core/files.h"

namespace saker::tools {
namespace {

using flight::testing::ScratchFolder;

bool has(const std::string& text, const std::string& what) {
  return text.find(what) != std::string::npos;
}

TEST(HtmlReport, HoldsPicturesTableFiguresAndConfiguration) {
  const ScratchFolder out;
  core::write_file(out / "results.json", R"({"found": 3, "targets": 4, "refusals": {"late": 2}})");
  core::write_file(out / "table.txt", "a table\n");
  core::write_file(out / "a.svg", "<svg><title>second</title></svg>");
  core::write_file(out / "map.svg", "<svg><title>first</title></svg>");
  flight::ProcessConfig config;
  config.ground.port = 9000;
  const auto file = write_html_report(out.path(), "A run", config);
  EXPECT_EQ(file, out / "report.html");
  const std::string page = core::read_file(file);
  EXPECT_TRUE(has(page, "<td>3 of 4</td>"));
  EXPECT_TRUE(has(page, "<pre>a table"));
  EXPECT_TRUE(has(page, "<td>plan</td><td>late</td><td>2</td>"));
  EXPECT_TRUE(has(page, "<td>ground.port</td><td>9000</td><td>8765</td>"));
  EXPECT_LT(page.find("first"), page.find("second"));
}

TEST(HtmlReport, OfAnEmptyFolderSaysThatAllValuesAreTheDefaultOnes) {
  const ScratchFolder out;
  const std::string page = core::read_file(write_html_report(out.path(), "A run", {}));
  EXPECT_TRUE(has(page, "<h1>A run</h1>"));
  EXPECT_TRUE(has(page, "all values are the default ones"));
}

TEST(HtmlReport, ResultsOfAnotherMakeAreAnErrorThatNamesTheFile) {
  const ScratchFolder out;
  for (const char* text : {"{", R"({"events": [{"t_s": "late"}]})"}) {
    core::write_file(out / "results.json", text);
    try {
      static_cast<void>(write_html_report(out.path(), "A run", {}));
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_TRUE(has(error.what(), "results.json")) << error.what();
    }
  }
}

}  // namespace
}  // namespace saker::tools
