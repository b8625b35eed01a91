#include "tools/saker/map/map_merge.h"

#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <numbers>

#include "saker/core/error.h"
#include "saker/multirobot/merge.h"
#include "saker/objects/map_io.h"
#include "tools/saker/command.h"
#include "tools/saker/configuration.h"

namespace saker::tools {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kFrontLogOdds = 2;  // of a vehicle's front, as a map states it
constexpr int kIterations = 50;

struct MergeOptions {
  std::vector<std::string> maps;
  bool same_frame = false;
  double frame_sd_m = 0.3, frame_sd_deg = 1;
};

/// What a map says of an object without a covariance, by what constellations expect of maps.
Eigen::MatrixXd usual_covariance(const slam::Model& model,
                                 const multirobot::ConstellationConfig& config) {
  const double turn = config.heading_sd_deg * kDegree;
  if (slam::is_cuboid(model)) {
    Vector9d sd;
    sd << turn, turn, turn, Eigen::Vector3d::Constant(config.place_sd_m),
        Eigen::Vector3d::Constant(config.size_sd_m);
    return sd.cwiseAbs2().asDiagonal();
  }
  Vector6d sd;
  sd << Eigen::Vector3d::Constant(config.place_sd_m), turn, turn, config.radius_sd_m;
  return sd.cwiseAbs2().asDiagonal();
}

/// A map as a flight of one keyframe, from which everything was measured.
slam::History as_history(const objects::ObjectMap& map, const std::string& name,
                         const multirobot::ConstellationConfig& config) {
  slam::HistoryEntry entry;
  for (const objects::MapObject& object : map.objects) {
    objects::Measurement measurement;
    measurement.class_id = object.class_id;
    measurement.class_probability = object.class_probability;
    measurement.model = object.model;
    measurement.covariance = object.covariance;
    if (!slam::valid({object.model, object.covariance}))
      measurement.covariance = usual_covariance(object.model, config);
    measurement.front_log_odds = kFrontLogOdds;
    entry.measurements.push_back(std::move(measurement));
  }
  return {name, 1, {entry}};
}

/// A map, or the one in the folder of a run.
objects::ObjectMap read(const std::string& name, const objects::ClassTable& table) {
  const std::filesystem::path file(name);
  return objects::read_map(std::filesystem::is_directory(file) ? file / "map.json" : file, table);
}

slam::PosePrior same_frame(const MergeOptions& options) {
  Vector6d sd;
  sd << Eigen::Vector3d::Constant(options.frame_sd_deg * kDegree),
      Eigen::Vector3d::Constant(options.frame_sd_m);
  return {SE3::Identity(), sd.cwiseAbs2().asDiagonal()};
}

void print(const std::string& name, const multirobot::MergeReport& report,
           const multirobot::MultiRobotSlam& merged) {
  if (report.status == multirobot::MergeStatus::not_aligned) {
    std::cout << fmt::format("{}: left out, {} (probability of being wrong {:.1e})\n", name,
                             to_string(report.alignment.status),
                             report.alignment.probability_wrong);
    return;
  }
  const SE3& T = merged.flights().back().keyframes.front().T_world_lidar;
  const Eigen::Vector3d& t = T.translation();
  std::cout << fmt::format(
      "{}: {} objects known, {} new; at ({:.2f}, {:.2f}, {:.2f}) m, turned by {:.2f} degrees", name,
      report.matched, report.created, t.x(), t.y(), t.z(), core::yaw(T.linear()) / kDegree);
  if (!report.alignment.matches.empty()) {
    std::cout << fmt::format("; aligned by {} objects, probability of being wrong {:.1e}",
                             report.alignment.matches.size(), report.alignment.probability_wrong);
  }
  std::cout << "\n";
}

void add_ground(objects::ObjectMap& all, const objects::ObjectMap& map, const SE3& T_all_map) {
  for (const objects::GroundPlane& plane : map.ground)
    all.ground.push_back(objects::transformed(T_all_map, plane));
}

int merge(const MergeOptions& options, const CommonOptions& common) {
  const auto configuration = read_configuration(common).autonomy;
  const std::filesystem::path out = output_file(common.out, common.force);
  multirobot::MultiRobotSlam merged(configuration.multirobot, configuration.slam,
                                    configuration.objects);
  objects::ObjectMap ground;
  int left_out = 0;
  for (const std::string& name : options.maps) {
    const objects::ObjectMap map = read(name, configuration.objects);
    if (map.objects.empty()) throw Error(name + ": no objects, expected at least one");
    std::optional<slam::PosePrior> start;
    if (options.same_frame && !merged.flights().empty()) start = same_frame(options);
    const multirobot::MergeReport report =
        merged.add(as_history(map, name, configuration.multirobot.constellation), start,
                   core::Budget::iterations(kIterations));
    if (report.status == multirobot::MergeStatus::nothing_new)
      throw Error(name + ": given twice, expected different maps");
    print(name, report, merged);
    if (report.status != multirobot::MergeStatus::merged) {
      ++left_out;
      continue;
    }
    add_ground(ground, map, merged.flights().back().keyframes.front().T_world_lidar);
  }
  objects::ObjectMap result = merged.map_with_covariance().map;
  result.ground = std::move(ground.ground);
  objects::write_map(out, result, configuration.objects);
  std::cout << fmt::format("{} objects of {} maps in {}\n", result.objects.size(),
                           merged.flights().size(), out.string());
  return left_out == 0 ? 0 : 1;
}

}  // namespace

void add_map_merge(Commands& commands, CLI::App& group) {
  auto options = std::make_shared<MergeOptions>();
  CLI::App& app =
      commands.add(group,
                   {.name = "merge",
                    .does = "several maps in one, in the frame of the first",
                    .output = Output::file,
                    .example = "saker map merge first/map.json second -o merged.json"},
                   [options](const CommonOptions& common) { return merge(*options, common); });
  app.add_option("MAPS", options->maps, "maps (.json or .smap), or folders of runs")
      ->required()
      ->expected(2, 100);
  app.add_flag(
      "--same-frame", options->same_frame,
      "all maps are in one frame; without it they are aligned by what they have in common");
  app.add_option("--frame-sd", options->frame_sd_m, "of the frames, with --same-frame, m")
      ->capture_default_str();
  app.add_option("--frame-sd-deg", options->frame_sd_deg, "the same in degrees")
      ->capture_default_str();
}

}  // namespace saker::tools
