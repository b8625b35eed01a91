#include "flight/viewers/site.h"

#include "saker/autonomy/config.h"
#include "saker/core/error.h"

namespace saker::flight::viewers {

Site site_of(const autonomy::Config& config, const std::vector<double>& origin) {
  Site site{.classes = config.objects,
            .geofence = config.motion.geofence,
            .origin = std::nullopt,
            .prior = {},
            .T_body_lidar = lidar::mount_pose(config.mount),
            .battery_return_share = config.safety.battery_return_share,
            .battery_land_share = config.safety.battery_land_share,
            .land_after_s = config.safety.land_after_s};
  if (origin.empty()) return site;
  if (origin.size() != 2 && origin.size() != 3)
    throw Error("site.origin: " + std::to_string(origin.size()) +
                " numbers, expected latitude, longitude and heading");
  site.origin = {.latitude_deg = origin[0], .longitude_deg = origin[1]};
  if (origin.size() == 3) site.origin->heading_deg = origin[2];
  static_cast<void>(objects::TangentPlane(*site.origin));  // throws on what is no place
  return site;
}

}  // namespace saker::flight::viewers
