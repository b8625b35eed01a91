#pragma once

#include <vector>

#include "lidar/scan.h"
#include "segmentation/network.h"
#include "segmentation/range_image.h"

namespace saker::segmentation {

/// Gives every point of the scan a class from the classes of the pixels.
///
/// The point that a pixel shows takes the pixel's probabilities. A point that hides behind it (more
/// points than pixels, two returns in one) asks the pixels around it, each weighted by how near its
/// own point is: the nearest-neighbour vote of RangeNet++ (Milioto et al., IROS 2019, sec. III-D),
/// on probabilities and for these points only. Points without a pixel are `other` with probability
/// 0.
class BackProjection {
 public:
  [[nodiscard]] lidar::Labels label(const lidar::Scan& scan, const RangeImage& image,
                                    const PixelProbabilities& pixels);

 private:
  void vote(const Eigen::Vector3f& point, std::size_t pixel, const RangeImage& image,
            const PixelProbabilities& pixels);

  std::vector<float> votes_;
};

}  // namespace saker::segmentation
