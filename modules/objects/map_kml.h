#pragma once

#include <string>

#include "saker/objects/class_table.h"
#include "saker/objects/geodesy.h"
#include "saker/objects/object_map.h"

namespace saker::objects {

/// A map for programs that show the Earth: KML 2.2 (OGC 07-147r2), which is not read back.
///
/// A folder a class; a cuboid is its footprint, extruded to its height, a cylinder a point as high
/// as it. Heights are metres above the ground of whoever shows it, since where the map's ground
/// lies above the ellipsoid is not known. Each placemark carries id, class, probability,
/// observations and sizes (m) as data; `heading_deg` is clockwise from north.
/// Throws Error on an origin that is no place.
[[nodiscard]] std::string to_kml(const ObjectMap& map, const ClassTable& table,
                                 const GeoOrigin& origin);

}  // namespace saker::objects
