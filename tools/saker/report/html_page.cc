#include "tools/saker/report/html_page.h"

#include <fmt/format.h>

#include "saker/core/error.h"
#include "saker/core/markup.h"

namespace saker::tools {
namespace {

constexpr const char* kStyle =
    "body{font:15px/1.45 system-ui,sans-serif;color:#1b2430;max-width:1080px;margin:0 auto;"
    "padding:24px}h1{font-size:24px}h2{font-size:18px;margin-top:32px;border-bottom:1px solid "
    "#c9d1d9}table{border-collapse:collapse;display:block;overflow-x:auto}th,td{text-align:left;"
    "padding:3px 14px 3px 0;vertical-align:top;border-bottom:1px solid #e4e8ec}th{color:#57606a;"
    "font-weight:600}td{font-variant-numeric:tabular-nums}pre{overflow-x:auto;background:#f6f8fa;"
    "padding:12px;font-size:13px}figure{margin:16px 0}figcaption{color:#57606a}svg{width:100%;"
    "height:auto}@media print{h2{break-after:avoid}figure{break-inside:avoid}}";

std::string escaped(const std::string& text) { return core::escaped_markup(text, true); }

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at)) {
    text.replace(at, what.size(), by);
    at += by.size();
  }
  return text;
}

std::string row_of(const HtmlPage::Row& cells, const char* tag) {
  std::string row = "<tr>";
  for (const std::string& cell : cells) row += fmt::format("<{0}>{1}</{0}>", tag, escaped(cell));
  return row + "</tr>\n";
}

}  // namespace

HtmlPage::HtmlPage(const std::string& title) : title_(title) {
  body_ = fmt::format("<h1>{}</h1>\n", escaped(title));
}

void HtmlPage::heading(const std::string& text) {
  body_ += fmt::format("<h2>{}</h2>\n", escaped(text));
}

void HtmlPage::paragraph(const std::string& text) {
  body_ += fmt::format("<p>{}</p>\n", escaped(text));
}

void HtmlPage::preformatted(const std::string& text) {
  body_ += fmt::format("<pre>{}</pre>\n", escaped(text));
}

void HtmlPage::table(const Row& head, const std::vector<Row>& rows) {
  if (rows.empty()) return;
  body_ += "<table>\n";
  if (!head.empty()) body_ += "<thead>" + row_of(head, "th") + "</thead>\n";
  body_ += "<tbody>\n";
  for (const Row& row : rows) body_ += row_of(row, "td");
  body_ += "</tbody></table>\n";
}

void HtmlPage::picture(const std::string& svg, const std::string& caption) {
  const std::size_t begin = svg.find("<svg");
  if (begin == std::string::npos) throw Error(caption + ": expected an SVG");
  // Pictures clip by the id `view`; a page has each id once.
  const std::string id = fmt::format("view{}", ++pictures_);
  std::string inside = replaced(svg.substr(begin), "id=\"view\"", fmt::format("id=\"{}\"", id));
  inside = replaced(inside, "url(#view)", fmt::format("url(#{})", id));
  body_ +=
      fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", inside, escaped(caption));
}

std::string HtmlPage::text() const {
  return fmt::format(
      "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\">\n<head>\n"
      "<meta charset=\"utf-8\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
      "<title>{}</title>\n<style>{}</style>\n</head>\n<body>\n{}</body>\n</html>\n",
      escaped(title_), kStyle, body_);
}

}  // namespace saker::tools
