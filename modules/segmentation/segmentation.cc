#include "saker/segmentation/segmentation.h"

#include <fstream>
#include <iterator>
#include <vector>

#include "saker/core/config_folder.h"
#include "saker/core/error.h"
#include "saker/segmentation/sidecar.h"

namespace saker::segmentation {
namespace {

namespace fs = std::filesystem;

std::string read_bytes(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw Error("cannot read model " + file.string());
  return {std::istreambuf_iterator<char>(stream), {}};
}

fs::path weights_of(const SegmentationConfig& config) {
  return core::find_in_configs(config.model, "segmentation.model");
}

fs::path description_of(const SegmentationConfig& config) {
  return weights_of(config).replace_extension(".yaml");
}

Network load(const SegmentationConfig& config, const objects::ClassTable& table) {
  const fs::path file = weights_of(config), description = description_of(config);
  const Sidecar sidecar = read_sidecar(description);
  const std::string weights = read_bytes(file);
  return Network(weights, file, kChannelCount, check_sidecar(sidecar, description, table, weights));
}

}  // namespace

Segmentation::Segmentation(const SegmentationConfig& config, const objects::ClassTable& table,
                           const Eigen::Vector3f& up)
    : config_(core::checked(config, "segmentation")),
      network_(load(config_, table)),
      features_(up),
      cylinders_(PieceFamily::cylinders, table, read_sidecar(description_of(config_)).cylinders),
      vehicles_(PieceFamily::vehicles, table, read_sidecar(description_of(config_)).vehicles) {}

/// The scan itself where its frame is the sensor's, else a copy in that.
const lidar::Scan& Segmentation::in_sensor_frame(const lidar::Scan& scan) {
  if (scan.T_lidar_sensor.matrix().isIdentity()) return scan;
  moved_ = scan;
  const Eigen::Isometry3f T_sensor_lidar = scan.T_lidar_sensor.inverse();
  for (Eigen::Vector3f& point : moved_.points) point = T_sensor_lidar * point;
  return moved_;
}

/// Streets have no handedness: the mean over the image and its mirror image (Simonyan and
/// Zisserman, ICLR 2015, sec. 3.2).
PixelProbabilities& Segmentation::probabilities() {
  const int rows = image_.rows, columns = image_.columns;
  PixelProbabilities& straight = network_.run(features_.compute(image_), rows, columns);
  if (!config_.mirrored) return straight;
  pixels_ = straight;
  const PixelProbabilities& mirrored = network_.run(features_.mirrored(), rows, columns);
  const Eigen::Index classes = pixels_.classes;
  for (int row = 0; row < rows; ++row) {
    const std::size_t begin = static_cast<std::size_t>(row) * columns * classes;
    Eigen::Map<Eigen::ArrayXXf> mean(&pixels_.values[begin], classes, columns);
    const Eigen::Map<const Eigen::ArrayXXf> other(&mirrored.values[begin], classes, columns);
    mean = 0.5F * (mean + other.rowwise().reverse());
  }
  return pixels_;
}

lidar::Labels Segmentation::segment(const lidar::Scan& given) {
  const lidar::Scan& scan = in_sensor_frame(given);
  project(scan, image_);
  if (image_.size() == 0)
    return {std::vector<std::uint8_t>(scan.size(), 0), std::vector<float>(scan.size(), 0.0F)};
  PixelProbabilities& pixels = probabilities();
  cylinders_.decide(image_, features_.up(), pixels);
  vehicles_.decide(image_, features_.up(), pixels);
  return back_projection_.label(scan, image_, pixels);
}

std::vector<Segmentation::SeenPiece> Segmentation::pieces(const lidar::Scan& given) {
  std::vector<SeenPiece> seen;
  project(in_sensor_frame(given), image_);
  if (image_.size() == 0) return seen;
  const PixelProbabilities& pixels = probabilities();
  for (const PieceFamily family : kPieceFamilies) {
    ObjectPieces& pieces = family == PieceFamily::cylinders ? cylinders_ : vehicles_;
    pieces.for_each(image_, features_.up(), pixels,
                    [&](const ObjectPieces::Piece& piece, const PieceFeatures& features) {
                      seen.push_back({family, features, {}});
                      for (const std::int32_t i : piece)
                        seen.back().points.push_back(image_.point[i]);
                    });
  }
  return seen;
}

}  // namespace saker::segmentation
