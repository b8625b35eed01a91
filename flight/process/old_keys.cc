#include "flight/process/old_keys.h"

namespace saker::flight {
namespace {

constexpr const char* kClass = "objects.classes says it of each class: saker config --all";
constexpr const char* kFaces =
    "a vehicle's faces have one likelihood, detection.vehicle.faces: saker config --all";

}  // namespace

const std::array<core::MovedKey, 28> kOldKeys = {{
    {"active.targets.default_size_m", nullptr, kClass},
    {"active.view.highest_deg", nullptr, "the sensor's metadata says its beams"},
    {"active.view.lowest_deg", nullptr, "the sensor's metadata says its beams"},
    {"base.relay", nullptr, "robots and ground are joined by saker-link: link.ground, link.port"},
    {"detection.vehicle.footprint.high_percentile", "detection.vehicle.hull.high_percentile", ""},
    {"detection.vehicle.footprint.low_percentile", "detection.vehicle.hull.low_percentile", ""},
    {"detection.vehicle.footprint.method", nullptr,
     "detection.vehicle.fitter is faces, or hull as in the paper (--preset paper)"},
    {"detection.vehicle.footprint", nullptr, kFaces},
    {"detection.vehicle.heading_cost", nullptr, kFaces},
    {"detection.vehicle.length_m", nullptr, kClass},
    {"detection.vehicle.length_sd_m", nullptr, kClass},
    {"detection.vehicle.noise.amid_others", nullptr, kFaces},
    {"detection.vehicle.noise.beyond", nullptr, kFaces},
    {"detection.vehicle.noise.edge_m", "detection.vehicle.hull.edge_m", ""},
    {"detection.vehicle.noise.edge_per_m", "detection.vehicle.hull.edge_per_m", ""},
    {"detection.vehicle.noise.goes_on", nullptr, kFaces},
    {"detection.vehicle.noise.setback", nullptr, kFaces},
    {"detection.vehicle.noise.unseen_m", nullptr, kFaces},
    {"detection.vehicle.prior_windows", nullptr, kFaces},
    {"detection.vehicle.tall", nullptr, kClass},
    {"detection.vehicle.width_m", nullptr, kClass},
    {"detection.vehicle.width_sd_m", nullptr, kClass},
    {"fit.whole_width_sd_m", nullptr, "the fit takes every window that shows both ends"},
    {"odometry.motion.max_interval_s", nullptr, "odometry.motion.max_coast_s bounds it, too"},
    {"slam.landmarks.vehicle_length_m", nullptr, kClass},
    {"slam.merge", "multirobot", ""},
    {"slam.noise.fitted_class_width_m", nullptr, kClass},
    {"slam.noise.fitted_hidden_side_m", nullptr,
     "where a side was hidden, its window says how badly it is known"},
}};

}  // namespace saker::flight
