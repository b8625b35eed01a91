#pragma once

#include <Eigen/Core>
#include <vector>

#include "saker/segmentation/beam_spacing.h"
#include "saker/segmentation/range_image.h"

namespace saker::segmentation {

/// Height above the local ground, for every pixel of a range image: the one input that means the
/// same to a car's roof, a hovering robot and a tilted one.
///
/// 1. Up: the mean of the surface normals, in a cone that shrinks (60°, 30°, 15°) about what is up
///    as the lidar is mounted.
/// 2. Ground: the lowest point in each cell of 1.5 m along that direction, then the greatest
///    surface under those that nowhere climbs faster than 25 % (a distance transform in two
///    passes), so that roofs and crowns with no ground below them get the ground beside them.
///
/// Reflections seem to come from below: lone points, without a neighbour in their row, points far
/// under the level of most upward surfaces, and a few low points in a cell that is a pit because of
/// them do not count. Cost: 2–3 ms for 64×1024.
class GroundHeight {
 public:
  /// \param up  unit, lidar frame, while the vehicle is level: z, unless the lidar is tilted.
  explicit GroundHeight(const Eigen::Vector3f& up = Eigen::Vector3f::UnitZ()) : mounted_up_(up) {}

  /// Unit normals towards the sensor, lidar frame, zero where a pixel has no surface around it.
  [[nodiscard]] const std::vector<Eigen::Vector3f>& normals() const { return normals_; }
  [[nodiscard]] const Eigen::Vector3f& up() const { return up_; }             ///< unit, lidar frame
  [[nodiscard]] const std::vector<float>& height() const { return height_; }  ///< m; 0: no return

  /// \param spacing  of the image.
  void estimate(const RangeImage& image, const BeamSpacing& spacing);

 private:
  void find_normals(const RangeImage& image, const BeamSpacing& spacing);
  void find_up();
  void level(const RangeImage& image);
  [[nodiscard]] float usual_level();
  void sort_into_cells(const RangeImage& image);
  void find_lowest();
  [[nodiscard]] bool is_pit(int cell);
  void drop_strays();
  void limit_slope();
  [[nodiscard]] float ground_at(float x, float y) const;

  std::vector<Eigen::Vector3f> normals_;
  std::vector<float> height_;
  std::vector<Eigen::Vector3f> level_;  // points in a frame whose z is up_
  std::vector<float> lowest_;           // one a cell
  std::vector<std::int32_t> cell_;      // of each pixel; −1: does not count
  std::vector<bool> pit_;               // of each cell
  std::vector<std::int32_t> strays_;
  std::vector<float> scratch_;
  Eigen::Vector3f mounted_up_;
  Eigen::Vector3f up_ = mounted_up_;
};

}  // namespace saker::segmentation
