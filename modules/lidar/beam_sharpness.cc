#include "saker/lidar/beam_sharpness.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "saker/core/rng.h"
#include "saker/lidar/rings.h"

namespace saker::lidar {
namespace {

constexpr int kSectors = 24;
constexpr int kTileBins = 24;
constexpr std::size_t kSampled = 24000, kFewest = 2000;
constexpr Eigen::Index kFewEvery = 2;
constexpr float kSharpest = 6;  // ratio; sharper beams than that say nothing more
// A tile's weight ends at this share of the points: the ground, seen from a point in its plane, is
// one sharp tile.
constexpr float kMostWeight = 0.05F;
constexpr float kFullTile = 0.35F;  // share of points; no sensor's beams are that narrow

int sector_of(const Eigen::Vector3f& p) {
  const float turn = std::atan2(p.y(), p.x()) / (2 * std::numbers::pi_v<float>)+0.5F;
  return std::clamp(static_cast<int>(turn * kSectors), 0, kSectors - 1);
}

/// A random share: a regular one would pick the same beam again and again.
std::vector<Eigen::Vector3f> sample(const std::vector<Eigen::Vector3f>& points) {
  std::vector<Eigen::Vector3f> finite;
  for (const Eigen::Vector3f& p : points) {
    const float range = p.norm();  // of the largest numbers not finite
    if (std::isfinite(range) && range > kMinRange) finite.push_back(p);
  }
  core::Rng rng(1);
  for (std::size_t i = 0; finite.size() > kSampled && i < kSampled; ++i) {
    std::swap(finite[i], finite[i + rng.index(static_cast<int>(finite.size() - i))]);
  }
  if (finite.size() > kSampled) finite.resize(kSampled);
  return finite;
}

struct Tile {
  double same = 0;   ///< pairs in one bin
  double pairs = 0;  ///< in the tile
  double points = 0;
};

float mean_log_ratio(const std::vector<Tile>& tiles, double points) {
  double sum = 0, weight = 0;
  for (const Tile& tile : tiles) {
    if (tile.points > kFullTile * points) return 0;
    if (tile.pairs < 2 * kTileBins) continue;
    const double ratio = kTileBins * tile.same / tile.pairs;
    const double w = std::min(tile.points, kMostWeight * points);
    sum += w * std::log(std::clamp<double>(ratio, 1 / kSharpest, kSharpest));
    weight += w;
  }
  return weight > 0 ? static_cast<float>(sum / weight) : 0;
}

/// The number of each point's bin of sin(elevation), 0 … 2 / bin.
template <class Points>
Eigen::ArrayXi bins_of(const Points& points, const SensorPose& pose, float bin) {
  const Eigen::Vector3f axis = sensor_axis(pose);
  const auto x = points.x - pose[0], y = points.y - pose[1], z = points.z - pose[2];
  const auto along = axis.x() * x + axis.y() * y + axis.z() * z;
  const auto inverse_range = (x * x + y * y + z * z + 1e-6F).rsqrt();
  return ((along * inverse_range + 1) / bin).max(0).min(2 / bin).template cast<int>();
}

}  // namespace

Eigen::Vector3f sensor_axis(const SensorPose& pose) {
  const float roll = pose[3], pitch = pose[4];
  return {std::sin(pitch) * std::cos(roll), -std::sin(roll), std::cos(pitch) * std::cos(roll)};
}

BeamSharpness::BeamSharpness(const std::vector<Eigen::Vector3f>& points) {
  const std::vector<Eigen::Vector3f> sampled = sample(points);
  if (sampled.size() < kFewest) return;
  std::vector<std::vector<Eigen::Vector3f>> sectors(kSectors);
  for (const Eigen::Vector3f& p : sampled) sectors[sector_of(p)].push_back(p);
  const auto count = static_cast<Eigen::Index>(sampled.size());
  all_.x.resize(count), all_.y.resize(count), all_.z.resize(count);
  Eigen::Index at = 0;
  for (const auto& sector : sectors) {
    all_.sector.push_back(at);
    for (const Eigen::Vector3f& p : sector) {
      all_.x[at] = p.x(), all_.y[at] = p.y(), all_.z[at] = p.z();
      ++at;
    }
  }
  all_.sector.push_back(at);
  const auto every = Eigen::seqN(0, count / kFewEvery, kFewEvery);
  few_ = {all_.x(every), all_.y(every), all_.z(every), {0, count / kFewEvery}};
}

float BeamSharpness::whole(const SensorPose& pose, float bin) const {
  return sharpness(few_, pose, bin);
}

float BeamSharpness::by_sector(const SensorPose& pose, float bin) const {
  return sharpness(all_, pose, bin);
}

float BeamSharpness::share_between_beams(const SensorPose& pose, float bin) const {
  const Eigen::ArrayXi index = bins_of(all_, pose, bin);
  const auto tile_count = static_cast<std::size_t>(2 / bin) / kTileBins + 1;
  std::vector<int> bins(tile_count * kTileBins), tiles(tile_count);
  for (const int k : index) ++bins[k], ++tiles[k / kTileBins];
  int between = 0;
  for (const int k : index) between += bins[k] * kTileBins < tiles[k / kTileBins];
  return static_cast<float>(between) / static_cast<float>(index.size());
}

float BeamSharpness::sharpness(const Points& points, const SensorPose& pose, float bin) {
  const auto tile_count = static_cast<std::size_t>(2 / bin) / kTileBins + 1;
  std::vector<Tile> tiles(tile_count);
  std::vector<std::int32_t> bins(tile_count * kTileBins);
  const Eigen::ArrayXi index = bins_of(points, pose, bin);
  for (std::size_t s = 0; s + 1 < points.sector.size(); ++s) {
    std::fill(bins.begin(), bins.end(), 0);
    for (Eigen::Index i = points.sector[s]; i < points.sector[s + 1]; ++i) ++bins[index[i]];
    for (std::size_t t = 0; t < tile_count; ++t) {
      std::int32_t same = 0, all = 0;
      for (int k = 0; k < kTileBins; ++k) {
        const std::int32_t h = bins[t * kTileBins + k];
        same += h * h, all += h;
      }
      if (all == 0) continue;
      tiles[t].same += same - all;
      tiles[t].pairs += static_cast<double>(all) * (all - 1);
      tiles[t].points += all;
    }
  }
  return mean_log_ratio(tiles, static_cast<double>(points.x.size()));
}

}  // namespace saker::lidar
