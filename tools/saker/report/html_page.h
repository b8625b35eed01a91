#pragma once

#include <string>
#include <vector>

namespace saker::tools {

/// A page of one file: no script, no address, nothing that is read from elsewhere. Well-formed XML,
/// so that other programs read it, too. Texts are escaped here.
class HtmlPage {
 public:
  using Row = std::vector<std::string>;

  explicit HtmlPage(const std::string& title);

  void heading(const std::string& text);
  void paragraph(const std::string& text);
  void preformatted(const std::string& text);
  /// Nothing where there is no row. \param head  as many as each row has; empty: none
  void table(const Row& head, const std::vector<Row>& rows);
  /// \param svg  a file's content; its ids are made its own. Throws Error where it is no SVG
  void picture(const std::string& svg, const std::string& caption);

  [[nodiscard]] std::string text() const;

 private:
  std::string title_, body_;
  int pictures_ = 0;
};

}  // namespace saker::tools
