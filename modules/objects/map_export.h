#pragma once

#include <string>

#include "saker/core/colour.h"
#include "saker/objects/class_table.h"
#include "saker/objects/geodesy.h"
#include "saker/objects/object_map.h"

/// Object maps for other programs; none of these forms is read back.
namespace saker::objects {

/// A line an object with the header `id,class,probability,observations,x_m,y_m,z_m,axis_x,axis_y,
/// axis_z,heading_deg,length_m,width_m,height_m,radius_m,sd_x_m,sd_y_m,sd_z_m,sd_length_m,
/// sd_width_m,sd_height_m,sd_radius_m`: the middle of a cuboid or the root of a cylinder in the
/// map's frame, its upward axis, heading from the map's x axis to its y axis. Empty: does not apply
/// or is not known. sd of places: in the object's own frame.
[[nodiscard]] std::string to_csv(const ObjectMap& map, const ClassTable& table);

/// RFC 7946: footprints of cuboids as polygons, roots of cylinders as points. Of the properties,
/// `heading_deg` is clockwise from the origin's north, `z_m` the height in the map's frame.
[[nodiscard]] std::string to_geojson(const ObjectMap& map, const ClassTable& table,
                                     const GeoOrigin& origin);

/// A mesh for viewers, binary: cuboids and cylinders, coloured by class.
[[nodiscard]] std::string to_ply(const ObjectMap& map, const ClassTable& table);

/// What these forms and KML draw a class in.
[[nodiscard]] core::Colour colour_of(const ObjectClass& object_class);

}  // namespace saker::objects
