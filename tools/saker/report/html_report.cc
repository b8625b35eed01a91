#include "tools/saker/report/html_report.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>

#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/objects/map_io.h"
#include "tools/saker/report/changed_values.h"
#include "tools/saker/report/html_page.h"
#include "tools/saker/report/report_parts.h"

namespace saker::tools {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostObjects = 2000;  // in the page; map.json has all

ReportJson results_of(const fs::path& out) {
  const fs::path file = out / "results.json";
  if (!fs::exists(file)) return ReportJson::object();
  try {
    return ReportJson::parse(core::read_file(file));
  } catch (const ReportJson::exception& error) {
    throw Error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

/// map.svg first, the others by their names.
std::vector<fs::path> pictures_of(const fs::path& out) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(out)) {
    if (entry.path().extension() == ".svg") files.push_back(entry.path());
  }
  std::ranges::sort(files, {}, [](const fs::path& file) {
    return std::pair(file.filename() != "map.svg", file.filename().string());
  });
  return files;
}

void add_section(HtmlPage& page, const std::string& heading, const HtmlPage::Row& head,
                 const std::vector<HtmlPage::Row>& rows) {
  if (rows.empty()) return;
  page.heading(heading);
  page.table(head, rows);
}

void add_objects(HtmlPage& page, const fs::path& out, const objects::ClassTable& table) {
  if (!fs::exists(out / "map.json")) return;
  const objects::ObjectMap map = objects::read_map(out / "map.json", table);
  add_section(page, fmt::format("Objects: {}", map.objects.size()),
              {"id", "class", "seen", "place", "size ± standard deviation"},
              object_rows(map, table, kMostObjects));
  if (map.objects.size() > kMostObjects)
    page.paragraph(fmt::format("{} more in map.json", map.objects.size() - kMostObjects));
}

void add_configuration(HtmlPage& page, const flight::ProcessConfig& config) {
  std::vector<HtmlPage::Row> rows;
  for (const ChangedValue& changed : changed_values(config))
    rows.push_back({changed.key, changed.value, changed.normal});
  page.heading("Configuration that differs from the defaults");
  if (rows.empty()) page.paragraph("none: all values are the default ones");
  page.table({"key", "value", "default"}, rows);
}

/// Throws ReportJson::exception where results.json is of another make.
HtmlPage page_of(const fs::path& out, const std::string& title,
                 const flight::ProcessConfig& config) {
  const ReportJson results = results_of(out);
  HtmlPage page(title);
  page.table({}, summary_rows(results));
  for (const fs::path& picture : pictures_of(out))
    page.picture(core::read_file(picture), picture.stem().string());
  for (const char* table : {"table.txt", "report.txt"}) {
    if (fs::exists(out / table)) page.preformatted(core::read_file(out / table));
  }
  add_section(page, "Refused or fallen short", {"what", "why", "times"}, refused_rows(results));
  add_section(page, "What happened", {"time", "from → to", "cause", ""}, event_rows(results));
  add_objects(page, out, config.autonomy.objects);
  add_section(page, "Figures", {"results.json", ""}, figure_rows(results));
  add_configuration(page, config);
  return page;
}

}  // namespace

fs::path write_html_report(const fs::path& out, const std::string& title,
                           const flight::ProcessConfig& config) {
  try {
    const fs::path file = out / "report.html";
    core::write_file(file, page_of(out, title, config).text());
    return file;
  } catch (const ReportJson::exception& error) {
    throw Error(fmt::format("{}: {}", (out / "results.json").string(), error.what()));
  }
}

void leave_html_report(const fs::path& out, const std::string& title,
                       const flight::ProcessConfig& config) {
  spdlog::info("report: {}", write_html_report(out, title, config).string());
}

}  // namespace saker::tools
