#include "tools/saker/characterise/recorded_samples.h"

#include <fmt/format.h>

#include <algorithm>

#include "flight/run_files/detections_file.h"
#include "saker/core/error.h"
#include "saker/objects/map_io.h"
#include "tools/saker/replay/trajectory_truth.h"

namespace saker::tools {
namespace {

namespace fs = std::filesystem;

/// Of an object of a map that is taken for the truth: one that was seen once agrees with itself.
constexpr int kConvergedObservations = 10;

std::vector<KnownObject> known_objects(const objects::ObjectMap& map) {
  std::vector<KnownObject> known;
  for (const objects::MapObject& object : map.objects) {
    known.push_back({object.id, "", object.class_id, object.model});
  }
  return known;
}

objects::ObjectMap converged(objects::ObjectMap map) {
  std::erase_if(map.objects, [](const objects::MapObject& object) {
    return object.observations < kConvergedObservations;
  });
  return map;
}

/// Cuboids of the table with their true size, and the cylinders.
std::vector<KnownObject> sized(const std::vector<KnownObject>& mapped, const std::string& recording,
                               const DimensionsTable& table) {
  std::vector<KnownObject> known;
  for (KnownObject object : mapped) {
    if (auto* cuboid = std::get_if<objects::Cuboid>(&object.model)) {
      const auto entry = std::ranges::find_if(table.objects, [&](const Dimensions& d) {
        return d.recording == recording && d.id == object.id;
      });
      if (entry == table.objects.end()) continue;
      cuboid->size.head<2>() << entry->length_m, entry->width_m;
      object.kind = entry->kind;
    }
    known.push_back(std::move(object));
  }
  return known;
}

std::vector<KnownObject> truth_of(const fs::path& run, const std::string& recording,
                                  const KnownTruth& truth, const objects::ClassTable& table) {
  if (truth.map) return known_objects(*truth.map);
  std::vector<KnownObject> mapped =
      known_objects(converged(objects::read_map(run / "map.json", table)));
  return truth.dimensions ? sized(mapped, recording, *truth.dimensions) : mapped;
}

/// From `at` on, those of one window.
std::vector<objects::Measurement> window_at(const std::vector<objects::Measurement>& all,
                                            std::size_t at) {
  std::vector<objects::Measurement> window;
  for (; at < all.size() && (window.empty() || all[at].stamp == window.front().stamp); ++at) {
    window.push_back(all[at]);
  }
  return window;
}

std::string name_of(const fs::path& run) {
  const fs::path name = run.has_filename() ? run.filename() : run.parent_path().filename();
  return name.string();
}

}  // namespace

std::vector<uncertainty::Sample> recorded_samples(const fs::path& run, const KnownTruth& truth,
                                                  const objects::ClassTable& table) {
  const std::string recording = name_of(run);
  const std::vector<objects::Measurement> all =
      flight::read_detections(run / "detections.jsonl", table);
  const fs::path trajectory_file = run / "trajectory.txt";
  const std::vector<StampedPose> trajectory = read_trajectory(trajectory_file);
  if (trajectory.empty()) {
    throw Error(fmt::format("{}: no pose, expected one for each scan", trajectory_file.string()));
  }
  const std::vector<KnownObject> known = truth_of(run, recording, truth, table);
  std::vector<uncertainty::Sample> samples;
  for (std::size_t at = 0; at < all.size();) {
    const std::vector<objects::Measurement> window = window_at(all, at);
    at += window.size();
    const double t = to_seconds(window.front().stamp);
    const StampedPose* pose = pose_at(trajectory, t);
    if (pose == nullptr) {
      throw Error(fmt::format("{}: no pose at {:.6f} s, when detections.jsonl has measurements",
                              trajectory_file.string(), t));
    }
    const std::vector<int> objects = matched(window, pose->T_world_lidar, known);
    for (std::size_t i = 0; i < window.size(); ++i) {
      if (objects[i] < 0) continue;
      samples.push_back(sample_of_known(window[i], pose->T_world_lidar,
                                        known[static_cast<std::size_t>(objects[i])], recording,
                                        t - trajectory.front().t));
    }
  }
  return samples;
}

}  // namespace saker::tools
