#pragma once

#include <filesystem>
#include <string>

#include "flight/process/configuration.h"

namespace saker::tools {

/// Leaves OUT/report.html, a page of one file that a person can mail: pictures (every SVG of the
/// folder, the map first), table.txt or report.txt, the objects of map.json, what happened, what
/// was refused and why, all figures of results.json, and the values of the configuration that are
/// not the default ones. What the folder does not have is left out.
/// \return its path. Throws Error where a file cannot be read or written.
std::filesystem::path write_html_report(const std::filesystem::path& out, const std::string& title,
                                        const flight::ProcessConfig& config);

/// The same, and the line of the log that says where it is: a program's last one.
void leave_html_report(const std::filesystem::path& out, const std::string& title,
                       const flight::ProcessConfig& config);

}  // namespace saker::tools
