#pragma once

#include <vector>

namespace saker::lidar {

/// Elevation bands that hold one beam each, for a scan whose order says nothing of its rings.
struct ElevationBands {
  std::vector<float> lower_edge;  ///< rad, of each band, the highest first; the last is −∞

  [[nodiscard]] int count() const { return static_cast<int>(lower_edge.size()); }
  [[nodiscard]] int of(float elevation) const;  ///< 0 the highest
};

/// Finds the beams of a turning sensor from where its points lie, however unevenly they are spaced.
///
/// A beam fires once a step of azimuth, so that a band of elevation with one beam in it has hardly
/// more points in a cell of azimuth than steps. Each band costs `points over that` plus a price a
/// band; the cheapest cut of the elevation axis is found by dynamic programming (Bellman,
/// "On the approximation of curves by line segments using dynamic programming", 1961). Beams that
/// the car's motion has blurred stay one band as long as they do not overlap.
/// \param azimuth, elevation  rad, of each point, at least one
/// \param azimuth_step        rad, between two firings of a beam
/// \return at least one band and at most `most`
[[nodiscard]] ElevationBands find_elevation_bands(const std::vector<float>& azimuth,
                                                  const std::vector<float>& elevation,
                                                  float azimuth_step, int most);

/// The step of azimuth between two firings, from the gaps in the fullest thin slices of elevation.
/// \return rad; 0 where there are too few points to tell
[[nodiscard]] float find_azimuth_step(const std::vector<float>& azimuth,
                                      const std::vector<float>& elevation);

}  // namespace saker::lidar
