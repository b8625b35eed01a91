#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "saker/detection/window.h"
#include "saker/lidar/scan.h"
#include "saker/objects/class_table.h"
#include "saker/objects/measurement.h"

namespace saker::tools {

/// One scan and what was made of it. Everything in the scan's lidar frame, or to be moved into it.
struct ScanView {
  std::string title;
  const lidar::Scan& scan;
  const lidar::Labels& labels;                         ///< of `scan`
  const std::vector<detection::LabelledScan>& window;  ///< oldest first; the last one is `scan`
  const objects::Detections& detections;
};

/// Writes a PNG and an SVG: the range image by range and by class, below it the window's points
/// from above with the fitted models and the ground planes. Throws Error.
void write_scan_picture(const std::filesystem::path& file, const ScanView& view,
                        const objects::ClassTable& table);

}  // namespace saker::tools
