#pragma once

#include <optional>
#include <vector>

#include "saker/core/colour.h"
#include "saker/motion/geofence.h"
#include "saker/objects/geodesy.h"
#include "saker/objects/object_map.h"

namespace saker::autonomy {
struct Config;
}

namespace saker::flight::viewers {

/// What the ground knows without a robot: from its own configuration, which should be the robots',
/// and from files.
struct Site {
  objects::ClassTable classes;
  motion::GeofenceConfig geofence;
  std::optional<objects::GeoOrigin> origin;  ///< none: it is not known where on the Earth
  objects::ObjectMap prior;                  ///< may be empty; ids are those of targets
  SE3 T_body_lidar = SE3::Identity();
  double battery_return_share = 0.3, battery_land_share = 0.15;
  double land_after_s = 10;  ///< of holding
};

/// \param origin  as site.origin has it: latitude, longitude and, where it is not 90, heading of x;
/// empty: none. Throws Error on what is no place.
[[nodiscard]] Site site_of(const autonomy::Config& config, const std::vector<double>& origin);

/// Colours that are told apart by nearly everybody.
[[nodiscard]] core::Colour colour_of(const objects::ObjectClass& object_class);
/// \param robot  its place in the order in which robots were first heard
[[nodiscard]] core::Colour colour_of_robot(std::size_t robot);

}  // namespace saker::flight::viewers
