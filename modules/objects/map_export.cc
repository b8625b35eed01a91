#include "saker/objects/map_export.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <numbers>

#include "saker/objects/object_numbers.h"

namespace saker::objects {
namespace {

constexpr int kSides = 16;  ///< of a cylinder's mesh

double heading_deg(double yaw) { return yaw * 180 / std::numbers::pi; }

std::string quoted(const std::string& text) { return nlohmann::json(text).dump(); }

/// CSV's own quotes, for names with commas.
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string doubled;
  for (const char c : text) {
    if (c == '"') doubled.push_back(c);
    doubled.push_back(c);
  }
  return fmt::format("\"{}\"", doubled);
}

std::string csv_model(const Cuboid& cuboid) {
  const Eigen::Vector3d p = cuboid.pose.translation(), up = cuboid.pose.linear().col(2);
  return fmt::format("{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.4f},{:.6f},{:.6f},{:.6f},",
                     p.x(), p.y(), p.z(), up.x(), up.y(), up.z(),
                     heading_deg(core::yaw(cuboid.pose.linear())), cuboid.size.x(), cuboid.size.y(),
                     cuboid.size.z());
}

std::string csv_model(const Cylinder& cylinder) {
  const Eigen::Vector3d &p = cylinder.root, &up = cylinder.axis;
  return fmt::format("{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},,,,{:.6f},{:.6f}", p.x(), p.y(),
                     p.z(), up.x(), up.y(), up.z(), cylinder.height, cylinder.radius);
}

std::string csv_deviations(const MapObject& object) {
  if (!has_covariance(object)) return ",,,,,,";
  const CovarianceNumbers sd = covariance_numbers(object);
  if (std::holds_alternative<Cuboid>(object.model)) {
    return fmt::format("{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},", sd[3], sd[4], sd[5], sd[6],
                       sd[7], sd[8]);
  }
  return fmt::format("{:.6f},{:.6f},{:.6f},,,,{:.6f}", sd[0], sd[1], sd[2], sd[5]);
}

std::string position_of(const TangentPlane& earth, const Eigen::Vector3d& p) {
  const GeoPoint at = earth.geodetic(p);
  return fmt::format("[{:.8f},{:.8f}]", at.longitude_deg, at.latitude_deg);
}

/// Counterclockwise from its front left corner.
std::string geometry(const Cuboid& cuboid, const TangentPlane& earth) {
  constexpr std::array<std::array<int, 2>, 5> kCorners = {
      {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}, {1, 1}}};
  std::string ring;
  for (const auto& [x, y] : kCorners) {
    const Eigen::Vector3d corner(x * cuboid.size.x() / 2, y * cuboid.size.y() / 2, 0);
    if (!ring.empty()) ring += ',';
    ring += position_of(earth, cuboid.pose * corner);
  }
  return fmt::format(R"({{"type":"Polygon","coordinates":[[{}]]}})", ring);
}

std::string geometry(const Cylinder& cylinder, const TangentPlane& earth) {
  return fmt::format(R"({{"type":"Point","coordinates":{}}})", position_of(earth, cylinder.root));
}

std::string properties(const Cuboid& cuboid, const TangentPlane& earth) {
  return fmt::format(
      R"("z_m":{:.3f},"length_m":{:.3f},"width_m":{:.3f},"height_m":{:.3f},"heading_deg":{:.2f})",
      cuboid.pose.translation().z(), cuboid.size.x(), cuboid.size.y(), cuboid.size.z(),
      earth.heading_deg(core::yaw(cuboid.pose.linear())));
}

std::string properties(const Cylinder& cylinder, const TangentPlane&) {
  return fmt::format(R"("z_m":{:.3f},"radius_m":{:.3f},"height_m":{:.3f})", cylinder.root.z(),
                     cylinder.radius, cylinder.height);
}

/// Vertices and faces as PLY has them.
class Mesh {
 public:
  void add(const Cuboid& cuboid, core::Colour colour) {
    constexpr std::array<std::array<int, 4>, 6> kFaces = {
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    const int first = vertices_;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d side((corner & 1) - 0.5, ((corner >> 1) & 1) - 0.5,
                                 (corner >> 2) - 0.5);
      vertex(cuboid.pose * side.cwiseProduct(cuboid.size), colour);
    }
    for (const auto& f : kFaces) face({first + f[0], first + f[1], first + f[2], first + f[3]});
  }

  void add(const Cylinder& cylinder, core::Colour colour) {
    const Eigen::Matrix<double, 3, 2> across = cylinder.radius * tangent_basis(cylinder.axis);
    const int first = vertices_;
    std::vector<int> bottom, top;
    for (int i = 0; i < kSides; ++i) {
      const double angle = 2 * std::numbers::pi * i / kSides;
      const Eigen::Vector3d foot =
          cylinder.root + across * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      vertex(foot, colour);
      vertex(foot + cylinder.height * cylinder.axis, colour);
      const int at = first + 2 * i, next = first + 2 * ((i + 1) % kSides);
      face({at, next, next + 1, at + 1});
      bottom.insert(bottom.begin(), at);
      top.push_back(at + 1);
    }
    face(bottom);
    face(top);
  }

  [[nodiscard]] std::string ply() const {
    return fmt::format(
               "ply\nformat binary_little_endian 1.0\nelement vertex {}\n"
               "property float x\nproperty float y\nproperty float z\n"
               "property uchar red\nproperty uchar green\nproperty uchar blue\n"
               "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
               vertices_, faces_) +
           vertex_bytes_ + face_bytes_;
  }

 private:
  template <class T>
  static void append(std::string& bytes, T value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
  }

  void vertex(const Eigen::Vector3d& p, core::Colour colour) {
    for (const double coordinate : p) append(vertex_bytes_, static_cast<float>(coordinate));
    for (const std::uint8_t channel : {colour.red, colour.green, colour.blue}) {
      append(vertex_bytes_, channel);
    }
    ++vertices_;
  }

  void face(const std::vector<int>& corners) {
    append(face_bytes_, static_cast<std::uint8_t>(corners.size()));
    for (const int corner : corners) append(face_bytes_, static_cast<std::int32_t>(corner));
    ++faces_;
  }

  std::string vertex_bytes_, face_bytes_;
  int vertices_ = 0, faces_ = 0;
};

}  // namespace

core::Colour colour_of(const ObjectClass& object_class) {
  if (object_class.shape == Shape::cuboid) return core::colours::kBlue;
  return object_class.crowned ? core::colours::kGreen : core::colours::kOrange;
}

std::string to_csv(const ObjectMap& map, const ClassTable& table) {
  std::string text =
      "id,class,probability,observations,x_m,y_m,z_m,axis_x,axis_y,axis_z,heading_deg,length_m,"
      "width_m,height_m,radius_m,sd_x_m,sd_y_m,sd_z_m,sd_length_m,sd_width_m,sd_height_m,"
      "sd_radius_m\n";
  for (const MapObject& object : map.objects) {
    text += fmt::format("{},{},{},{},", object.id, cell(table[object.class_id].name),
                        rounded(probability_of(object)), object.observations);
    text += std::visit([](const auto& model) { return csv_model(model); }, object.model);
    text += fmt::format(",{}\n", csv_deviations(object));
  }
  return text;
}

std::string to_geojson(const ObjectMap& map, const ClassTable& table, const GeoOrigin& origin) {
  const TangentPlane earth(origin);
  std::string text = R"({"type":"FeatureCollection","features":[)";
  const char* separator = "\n";
  for (const MapObject& object : map.objects) {
    const auto said = [&](const auto& model) {
      return fmt::format(R"("geometry":{},"properties":{{"id":{},"class":{},"probability":{},)",
                         geometry(model, earth), object.id, quoted(table[object.class_id].name),
                         rounded(probability_of(object))) +
             fmt::format(R"("observations":{},{}}}}})", object.observations,
                         properties(model, earth));
    };
    text += fmt::format(R"({}{{"type":"Feature",{})", separator, std::visit(said, object.model));
    separator = ",\n";
  }
  return text + "\n]}\n";
}

std::string to_ply(const ObjectMap& map, const ClassTable& table) {
  Mesh mesh;
  for (const MapObject& object : map.objects) {
    const core::Colour colour = colour_of(table[object.class_id]);
    std::visit([&](const auto& model) { mesh.add(model, colour); }, object.model);
  }
  return mesh.ply();
}

}  // namespace saker::objects
