#include "flight/viewers/foxglove_messages.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "flight/bus/fields.h"
#include "flight/viewers/foxglove_parts.h"

namespace saker::flight::viewers {
namespace {

constexpr int kUint8 = 1, kFloat32 = 7;  // foxglove.NumericType

void append(std::vector<std::uint8_t>& bytes, const Eigen::Vector3d& p) {
  static_assert(std::endian::native == std::endian::little);
  const Eigen::Vector3f xyz = p.cast<float>();
  std::array<std::uint8_t, 12> packed;
  std::memcpy(packed.data(), xyz.data(), packed.size());
  bytes.insert(bytes.end(), packed.begin(), packed.end());
}

Json transform(const std::string& parent, const std::string& child, const SE3& T, double t) {
  return {{"timestamp", time_json(t)},
          {"parent_frame_id", parent},
          {"child_frame_id", child},
          {"translation", vector_json(T.translation())},
          {"rotation", quaternion_json(Eigen::Quaterniond(T.rotation()))}};
}

std::optional<SE3> body_pose(const RobotState& state) {
  if (!state.odometry) return std::nullopt;
  const odometry_t& message = state.odometry->message;
  return pose_of(message.position, message.orientation);
}

Json cloud(const RobotState& state, double t, const std::vector<std::uint8_t>& bytes,
           bool reflects) {
  Json fields = Json::array();
  const char* const names[] = {"x", "y", "z"};
  for (int i = 0; i < 3; ++i)
    fields.push_back({{"name", names[i]}, {"offset", 4 * i}, {"type", kFloat32}});
  if (reflects) fields.push_back({{"name", "reflectivity"}, {"offset", 12}, {"type", kUint8}});
  return {{"timestamp", time_json(t)},          {"frame_id", frame_of(state, "odom")},
          {"pose", pose_json(SE3::Identity())}, {"point_stride", reflects ? 13 : 12},
          {"fields", std::move(fields)},        {"data", base64(bytes)}};
}

}  // namespace

Json time_json(double t) {
  constexpr double kMost = 4294967295;  // of uint32
  const double whole = t > 0 && t < kMost ? t : 0;
  const auto ns = static_cast<std::int64_t>(whole * 1e6) * 1000;
  return {{"sec", ns / kNanosecondsPerSecond}, {"nsec", ns % kNanosecondsPerSecond}};
}

Json vector_json(const Eigen::Vector3d& v) {
  return {{"x", rounded(v.x())}, {"y", rounded(v.y())}, {"z", rounded(v.z())}};
}

Json quaternion_json(const Eigen::Quaterniond& q) {
  return {
      {"x", rounded(q.x())}, {"y", rounded(q.y())}, {"z", rounded(q.z())}, {"w", rounded(q.w())}};
}

Json pose_json(const SE3& T) {
  return {{"position", vector_json(T.translation())},
          {"orientation", quaternion_json(Eigen::Quaterniond(T.rotation()))}};
}

Json colour_json(const core::Colour& colour, double opacity) {
  constexpr double kMost = 255;
  return {{"r", rounded(colour.red / kMost)},
          {"g", rounded(colour.green / kMost)},
          {"b", rounded(colour.blue / kMost)},
          {"a", rounded(opacity)}};
}

std::optional<Json> frame_transforms(const RobotState& state, const Site& site, double t) {
  const auto T_odom_body = body_pose(state);
  if (!T_odom_body) return std::nullopt;
  const std::string world = frame_of(state, "world"), odom = frame_of(state, "odom");
  const std::string body = frame_of(state, "body");
  Json list = Json::array();
  list.push_back(transform("map", world, SE3::Identity(), t));
  list.push_back(transform(world, odom, SE3::Identity(), t));
  list.push_back(transform(odom, body, *T_odom_body, t));
  list.push_back(transform(body, frame_of(state, "lidar"), site.T_body_lidar, t));
  return Json{{"transforms", std::move(list)}};
}

std::optional<Json> location_fix(const RobotState& state, const Site& site, double t) {
  const auto T_odom_body = body_pose(state);
  if (!T_odom_body || !site.origin) return std::nullopt;
  const objects::GeoPoint place =
      objects::TangentPlane(*site.origin).geodetic(T_odom_body->translation());
  return Json{
      {"timestamp", time_json(t)},           {"frame_id", frame_of(state, "body")},
      {"latitude", place.latitude_deg},      {"longitude", place.longitude_deg},
      {"altitude", rounded(place.height_m)}, {"position_covariance", std::vector<double>(9, 0.0)},
      {"position_covariance_type", 0}};
}

Json log_message(const std::string& name, LogLevel level, const std::string& text, double t) {
  return {{"timestamp", time_json(t)},
          {"level", static_cast<int>(level)},
          {"message", text},
          {"name", name},
          {"file", ""},
          {"line", 0}};
}

std::optional<Json> point_cloud(const RobotState& state, double t, std::size_t most) {
  constexpr float kFarthest_m = 120;  // beams without an answer are said to end at 200 m or more
  if (!state.scan || !state.scan->message.points) return std::nullopt;
  const autonomy::RegisteredScan& scan = state.scan->message;
  const auto& points = *scan.points;
  const std::size_t stride = std::max<std::size_t>(1, (points.size() + most - 1) / most);
  const bool reflects = scan.reflectivity && scan.reflectivity->size() == points.size();
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    if (!(points[i].squaredNorm() < kFarthest_m * kFarthest_m)) continue;
    append(bytes, scan.T_odom_lidar * points[i].cast<double>());
    if (!reflects) continue;
    const float share = std::clamp((*scan.reflectivity)[i], 0.0f, 1.0f);
    bytes.push_back(static_cast<std::uint8_t>(std::lround(share * 255)));
  }
  return cloud(state, t, bytes, reflects);
}

std::optional<Json> occupied_cells(const RobotState& state, double t, double radius_m,
                                   std::size_t most) {
  if (!state.occupancy) return std::nullopt;
  const occupancy::OccupancyGrid& grid = state.occupancy->message;
  const auto body = body_pose(state);
  const Eigen::Vector3d centre =
      body ? Eigen::Vector3d(body->translation())
           : Eigen::Vector3d(grid.origin + grid.resolution_m / 2 * grid.size.cast<double>());
  std::vector<std::pair<double, Eigen::Vector3d>> cells;
  std::size_t offset = 0;
  for (int z = 0; z < grid.size.z(); ++z) {
    for (int y = 0; y < grid.size.y(); ++y) {
      for (int x = 0; x < grid.size.x(); ++x, ++offset) {
        if (grid.cells[offset] != occupancy::Cell::occupied) continue;
        const Eigen::Vector3d p = grid.centre_of({x, y, z});
        const double distance = (p - centre).norm();
        if (distance <= radius_m) cells.emplace_back(distance, p);
      }
    }
  }
  const auto nearer = [](const auto& a, const auto& b) { return a.first < b.first; };
  if (cells.size() > most) {
    std::nth_element(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(most), cells.end(),
                     nearer);
    cells.resize(most);
  }
  std::vector<std::uint8_t> bytes;
  for (const auto& [distance, p] : cells) append(bytes, p);
  Json json = cloud(state, t, bytes, false);
  json["resolution_m"] = rounded(grid.resolution_m);
  return json;
}

}  // namespace saker::flight::viewers
