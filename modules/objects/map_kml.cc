#include "saker/objects/map_kml.h"

#include <fmt/format.h>

#include <array>

#include "saker/core/markup.h"
#include "saker/objects/map_export.h"
#include "saker/objects/object_numbers.h"

namespace saker::objects {
namespace {

/// KML writes opacity, blue, green, red.
std::string style(ClassId id, const ObjectClass& object_class) {
  const core::Colour c = colour_of(object_class);
  const std::string bgr = fmt::format("{:02x}{:02x}{:02x}", c.blue, c.green, c.red);
  return fmt::format(
      "<Style id=\"class{0}\"><IconStyle><color>ff{1}</color></IconStyle><LabelStyle>"
      "<scale>0.7</scale></LabelStyle><LineStyle><color>ff{1}</color><width>2</width></LineStyle>"
      "<PolyStyle><color>b3{1}</color></PolyStyle></Style>\n",
      id, bgr);
}

std::string position_of(const TangentPlane& earth, const Eigen::Vector3d& p, double height) {
  const GeoPoint at = earth.geodetic(p);
  return fmt::format("{:.8f},{:.8f},{:.3f}", at.longitude_deg, at.latitude_deg, height);
}

constexpr const char* kAbove = "<extrude>1</extrude><altitudeMode>relativeToGround</altitudeMode>";

/// Counterclockwise from its front left corner.
std::string geometry(const Cuboid& cuboid, const TangentPlane& earth) {
  constexpr std::array<std::array<int, 2>, 5> kCorners = {
      {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}, {1, 1}}};
  std::string ring;
  for (const auto& [x, y] : kCorners) {
    const Eigen::Vector3d corner(x * cuboid.size.x() / 2, y * cuboid.size.y() / 2, 0);
    if (!ring.empty()) ring += ' ';
    ring += position_of(earth, cuboid.pose * corner, cuboid.size.z());
  }
  return fmt::format(
      "<Polygon>{}<outerBoundaryIs><LinearRing><coordinates>{}</coordinates></LinearRing>"
      "</outerBoundaryIs></Polygon>",
      kAbove, ring);
}

std::string geometry(const Cylinder& cylinder, const TangentPlane& earth) {
  return fmt::format("<Point>{}<coordinates>{}</coordinates></Point>", kAbove,
                     position_of(earth, cylinder.root, cylinder.height));
}

std::string datum(const char* name, const std::string& value) {
  return fmt::format("<Data name=\"{}\"><value>{}</value></Data>", name, value);
}

std::string sizes(const Cuboid& cuboid, const TangentPlane& earth) {
  const double heading = earth.heading_deg(core::yaw(cuboid.pose.linear()));
  return datum("length_m", fmt::format("{:.3f}", cuboid.size.x())) +
         datum("width_m", fmt::format("{:.3f}", cuboid.size.y())) +
         datum("height_m", fmt::format("{:.3f}", cuboid.size.z())) +
         datum("heading_deg", fmt::format("{:.2f}", heading));
}

std::string sizes(const Cylinder& cylinder, const TangentPlane&) {
  return datum("radius_m", fmt::format("{:.3f}", cylinder.radius)) +
         datum("height_m", fmt::format("{:.3f}", cylinder.height));
}

std::string placemark(const MapObject& object, const std::string& name, const TangentPlane& earth) {
  const auto said = [&](const auto& model) {
    return fmt::format("<ExtendedData>{}{}{}{}{}</ExtendedData>{}",
                       datum("id", fmt::format("{}", object.id)), datum("class", name),
                       datum("probability", fmt::format("{}", rounded(probability_of(object)))),
                       datum("observations", fmt::format("{}", object.observations)),
                       sizes(model, earth), geometry(model, earth));
  };
  return fmt::format(
      "<Placemark id=\"object{0}\"><name>{1} {0}</name><styleUrl>#class{2}</styleUrl>{3}"
      "</Placemark>\n",
      object.id, name, object.class_id, std::visit(said, object.model));
}

}  // namespace

std::string to_kml(const ObjectMap& map, const ClassTable& table, const GeoOrigin& origin) {
  const TangentPlane earth(origin);
  std::string styles, folders;
  for (int i = 0; i < table.size(); ++i) {
    const auto id = static_cast<ClassId>(i);
    const std::string name = core::escaped_markup(table[id].name);
    std::string placemarks;
    for (const MapObject& object : map.objects) {
      if (object.class_id == id) placemarks += placemark(object, name, earth);
    }
    if (placemarks.empty()) continue;
    styles += style(id, table[id]);
    folders += fmt::format("<Folder><name>{}</name>\n{}</Folder>\n", name, placemarks);
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<kml xmlns=\"http://www.opengis.net/kml/2.2\">\n<Document><name>Saker</name>\n{}{}"
      "</Document>\n</kml>\n",
      styles, folders);
}

}  // namespace saker::objects
