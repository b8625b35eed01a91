#include "flight/bus/scan_messages.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "flight/bus/fields.h"
#include "flight/bus/messages.h"

namespace saker::flight {
namespace {

constexpr float kCentimetresPerMetre = 100;
constexpr float kMostCentimetres = std::numeric_limits<std::int16_t>::max();
constexpr float kMostReflectivity = std::numeric_limits<std::uint8_t>::max();

bool fits(const Eigen::Vector3f& centimetres) {
  return (centimetres.array().abs() <= kMostCentimetres).all();  // false for NaN
}

scan_t empty_chunk(const autonomy::RegisteredScan& scan, std::int32_t sequence) {
  scan_t chunk{};
  chunk.utime = to_utime(scan.stamp);
  chunk.sequence = sequence;
  write_pose(scan.T_odom_lidar, chunk.position, chunk.orientation);
  for (auto* axis : {&chunk.x_cm, &chunk.y_cm, &chunk.z_cm}) axis->reserve(scan_t::MAX_POINTS);
  chunk.reflectivity.reserve(scan_t::MAX_POINTS);
  return chunk;
}

void append(scan_t& chunk, const Eigen::Vector3f& centimetres, float reflectivity) {
  chunk.x_cm.push_back(static_cast<std::int16_t>(std::lround(centimetres.x())));
  chunk.y_cm.push_back(static_cast<std::int16_t>(std::lround(centimetres.y())));
  chunk.z_cm.push_back(static_cast<std::int16_t>(std::lround(centimetres.z())));
  const float share = reflectivity > 0 ? std::min(reflectivity, 1.0f) : 0;  // NaN is 0
  chunk.reflectivity.push_back(static_cast<std::uint8_t>(std::lround(share * kMostReflectivity)));
  ++chunk.num_points;
}

bool is_whole(const scan_t& chunk) {
  const auto count = static_cast<std::size_t>(std::max(0, chunk.num_points));
  return chunk.num_points >= 0 && chunk.num_points <= scan_t::MAX_POINTS &&
         chunk.x_cm.size() == count && chunk.y_cm.size() == count && chunk.z_cm.size() == count &&
         chunk.reflectivity.size() == count;
}

}  // namespace

std::vector<scan_t> to_lcm(const autonomy::RegisteredScan& scan, std::int32_t sequence) {
  std::vector<scan_t> chunks = {empty_chunk(scan, sequence)};
  if (scan.points) {
    const bool reflects = scan.reflectivity && scan.reflectivity->size() == scan.points->size();
    for (std::size_t i = 0; i < scan.points->size(); ++i) {
      const Eigen::Vector3f centimetres = (*scan.points)[i] * kCentimetresPerMetre;
      if (!fits(centimetres)) continue;
      if (chunks.back().num_points == scan_t::MAX_POINTS) {
        if (chunks.size() == scan_t::MAX_CHUNKS) break;
        chunks.push_back(empty_chunk(scan, sequence));
      }
      append(chunks.back(), centimetres, reflects ? (*scan.reflectivity)[i] : 0);
    }
  }
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    chunks[i].chunk = static_cast<std::int16_t>(i);
    chunks[i].num_chunks = static_cast<std::int16_t>(chunks.size());
  }
  return chunks;
}

std::optional<autonomy::RegisteredScan> ScanJoiner::add(scan_t chunk) {
  const auto T = pose_of(chunk.position, chunk.orientation);
  accepted_ = T && is_whole(chunk);
  if (!accepted_) return std::nullopt;
  const long refused = joiner_.counters().refused;
  const Time stamp = from_utime(chunk.utime);
  const auto chunks = joiner_.add(std::move(chunk));
  accepted_ = joiner_.counters().refused == refused;
  if (!chunks) return std::nullopt;
  auto points = std::make_shared<std::vector<Eigen::Vector3f>>();
  auto reflectivity = std::make_shared<std::vector<float>>();
  for (const scan_t& part : *chunks) {
    for (std::size_t i = 0; i < part.x_cm.size(); ++i) {
      points->push_back(Eigen::Vector3f(part.x_cm[i], part.y_cm[i], part.z_cm[i]) /
                        kCentimetresPerMetre);
      reflectivity->push_back(static_cast<float>(part.reflectivity[i]) / kMostReflectivity);
    }
  }
  return autonomy::RegisteredScan{.stamp = stamp,
                                  .T_odom_lidar = *T,
                                  .points = std::move(points),
                                  .reflectivity = std::move(reflectivity)};
}

}  // namespace saker::flight
