#include "segmentation/segmentation.h"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <vector>

#include "core/error.h"
#include "segmentation/sidecar.h"

namespace saker::segmentation {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> config_folders() {
  std::vector<fs::path> folders;
  if (const char* given = std::getenv("SAKER_CONFIG_DIR")) folders.emplace_back(given);
  std::error_code failed;
  const fs::path program = fs::read_symlink("/proc/self/exe", failed);
  if (!failed) folders.push_back(program.parent_path() / "../../../configs");
  folders.emplace_back(SAKER_CONFIG_DIR);
  return folders;
}

std::string read_bytes(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw Error("cannot read model " + file.string());
  return {std::istreambuf_iterator<char>(stream), {}};
}

Network load(const SegmentationConfig& config, const objects::ClassTable& table) {
  const fs::path file = find_model(config.model);
  const fs::path description = fs::path(file).replace_extension(".yaml");
  const Sidecar sidecar = read_sidecar(description);
  const std::string weights = read_bytes(file);
  check_sidecar(sidecar, description, table, weights);
  return Network(weights, file, kChannelCount, table.size());
}

}  // namespace

fs::path find_model(const std::string& model) {
  if (fs::is_regular_file(model)) return model;
  std::string looked = model;
  for (const fs::path& folder : config_folders()) {
    const fs::path file = (folder / model).lexically_normal();
    if (fs::is_regular_file(file)) return file;
    if (looked.find(file.string()) == std::string::npos) looked += ", " + file.string();
  }
  throw Error("segmentation.model: no such file: looked for " + looked);
}

Segmentation::Segmentation(const SegmentationConfig& config, const objects::ClassTable& table)
    : config_(core::checked(config, "segmentation")), network_(load(config_, table)) {}

lidar::Labels Segmentation::segment(const lidar::Scan& scan) {
  project(scan, image_);
  if (image_.size() == 0)
    return {std::vector<std::uint8_t>(scan.size(), 0), std::vector<float>(scan.size(), 0.0F)};
  const PixelProbabilities& pixels =
      network_.run(features_.compute(image_), image_.rows, image_.columns);
  return back_projection_.label(scan, image_, pixels);
}

}  // namespace saker::segmentation
