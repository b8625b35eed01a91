#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <map>
#include <nlohmann/json.hpp>

#include "flight/bus/scan_log.h"
#include "saker/autonomy/lockstep.h"
#include "saker/core/config_folder.h"
#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/core/progress.h"
#include "saker/core/timings.h"
#include "saker/lidar/recording.h"
#include "saker/objects/map_io.h"
#include "tools/saker/command.h"
#include "tools/saker/configuration.h"
#include "tools/saker/picture/map_picture.h"
#include "tools/saker/record/run_recording.h"
#include "tools/saker/recording_input.h"
#include "tools/saker/replay/network_fit.h"
#include "tools/saker/replay/run_recorder.h"
#include "tools/saker/replay/shortfalls.h"
#include "tools/saker/replay/trajectory_truth.h"
#include "tools/saker/report/html_report.h"

namespace saker::tools {
namespace {

struct ReplayOptions {
  RecordingInput input;
  std::string format = "auto";
  std::string truth;
  std::string record;
};

const std::map<std::string, lidar::RecordingFormat> kFormats = {
    {"auto", lidar::RecordingFormat::kAutomatic},
    {"kitti", lidar::RecordingFormat::kKitti},
    {"ouster", lidar::RecordingFormat::kOuster}};

std::unique_ptr<lidar::ScanSource> open_input(const ReplayOptions& options) {
  const std::string& path = options.input.path;
  const bool log =
      options.format == "lcm" || (options.format == "auto" && flight::is_lcm_log(path));
  if (log) return std::make_unique<flight::ScanLog>(path);
  RecordingInput input = options.input;
  input.options.format = kFormats.at(options.format);
  return input.open();
}

/// Passes frames on, shows progress, times the reading and records scans.
class WatchedSource : public lidar::ScanSource {
 public:
  /// \param recording  may be null
  WatchedSource(lidar::ScanSource& source, core::Timings& timings, RunRecording* recording)
      : source_(source),
        timings_(timings),
        recording_(recording),
        progress_("replay", source.expected_scans()) {}

  std::optional<lidar::Frame> next() override {
    progress_.update(frames_++);
    auto frame = timings_.time("read", [&] { return source_.next(); });
    if (frame && recording_ != nullptr) recording_->add(frame->scan);
    return frame;
  }
  [[nodiscard]] lidar::SourceCounters counters() const override { return source_.counters(); }

 private:
  lidar::ScanSource& source_;
  core::Timings& timings_;
  RunRecording* recording_;
  core::Progress progress_;
  long frames_ = 0;
};

double path_length(const std::vector<SE3>& poses) {
  double length = 0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    length += (poses[i].translation() - poses[i - 1].translation()).norm();
  }
  return length;
}

std::vector<Eigen::Vector3d> positions(const std::vector<SE3>& poses) {
  std::vector<Eigen::Vector3d> result;
  for (const SE3& T : poses) result.emplace_back(T.translation());
  return result;
}

nlohmann::json scans_not_used(const autonomy::LockstepResult& result) {
  nlohmann::json list = nlohmann::json::array();
  for (std::size_t i = 0; i < result.scans.size(); ++i) {
    const autonomy::ScanRecord& scan = result.scans[i];
    if (odometry::registered(scan.status)) continue;
    const std::string reason = scan.fault.empty() ? to_string(scan.reason) : scan.fault;
    list.push_back({{"scan", i}, {"name", scan.name}, {"reason", reason}});
  }
  return list;
}

std::ptrdiff_t scans_not_held(const autonomy::LockstepResult& result) {
  return std::ranges::count(result.scans, odometry::OdometryStatus::open,
                            &autonomy::ScanRecord::status);
}

nlohmann::json source_figures(const lidar::SourceCounters& counters) {
  return {{"faulty_scans", counters.faulty_scans},
          {"bad_packets", counters.bad_packets},
          {"bad_columns", counters.bad_columns},
          {"lost_frames", counters.lost_frames},
          {"late_packets", counters.late_packets},
          {"repeated_columns", counters.repeated_columns},
          {"missing_columns", counters.missing_columns},
          {"clock_steps", counters.clock_steps},
          {"other_sensors", counters.other_sensors},
          {"imu_samples", counters.imu_samples},
          {"late_imu_samples", counters.late_imu_samples},
          {"lost_fragments", counters.lost_fragments},
          {"ended_early", counters.ended_early}};
}

std::map<std::string, int> object_counts(const std::vector<objects::MapObject>& objects,
                                         const objects::ClassTable& table) {
  std::map<std::string, int> counts;
  for (const objects::MapObject& object : objects) ++counts[table[object.class_id].name];
  return counts;
}

nlohmann::json figures(const autonomy::LockstepResult& result, double wall_s,
                       const objects::ClassTable& table) {
  const double duration = to_seconds(result.scans.back().stamp - result.scans.front().stamp);
  return {{"scans", result.scans.size()},
          {"duration_s", duration},
          {"wall_s", wall_s},
          {"real_time_factor", duration / wall_s},
          {"path_m", path_length(result.T_world_lidar)},
          {"labelled_scans", result.labelled_scans},
          {"segmentation_hz", duration > 0 ? (result.labelled_scans - 1) / duration : 0},
          {"slam_cycles", result.slam_cycles},
          {"keyframes", result.keyframes},
          {"objects", object_counts(result.map.objects, table)},
          {"tentative", object_counts(result.tentative, table)},
          {"segmentation",
           {{"probability", result.fit.probability},
            {"classified_share", result.fit.classified_share}}},
          {"scans_not_registered", scans_not_used(result)},
          {"scans_not_held", scans_not_held(result)}};
}

/// What a user wants to know at the end, and what was wrong with the recording.
void report(const nlohmann::json& results) {
  constexpr std::size_t kMostNamed = 20;  // the rest is in results.json
  std::size_t named = 0;
  for (const auto& scan : results["scans_not_registered"]) {
    if (++named > kMostNamed) break;
    spdlog::warn("scan {}: {}", scan["name"].get<std::string>(), scan["reason"].get<std::string>());
  }
  if (const int late = results["source"]["late_imu_samples"]; late > 0) {
    spdlog::warn("{} of {} inertial samples are not newer than those before: not used", late,
                 late + results["source"]["imu_samples"].get<int>());
  }
  if (results["source"]["imu_samples"] == 0) spdlog::info("without inertial samples");
  if (const std::string cause = results["source"]["ended_early"]; !cause.empty()) {
    spdlog::warn("the recording ends early: {}", cause);
  }
  spdlog::info("{} scans, {:.1f} s, in {:.1f} s: {:.2f} times real time",
               results["scans"].get<int>(), results["duration_s"].get<double>(),
               results["wall_s"].get<double>(), results["real_time_factor"].get<double>());
  spdlog::info("{:.1f} m flown, objects: {}", results["path_m"].get<double>(),
               results["objects"].dump());
  if (!results["tentative"].empty()) {
    spdlog::info("seen too seldom or not well enough for the map, dashed in map.png: {}",
                 results["tentative"].dump());
  }
}

/// A run that is over, and its folder.
struct LeftBehind {
  std::filesystem::path out;
  const flight::ProcessConfig& config;
  const autonomy::LockstepResult& result;
  const RunRecorder& recorder;
  const std::optional<Truth>& truth;
};

/// Everything of it that is drawn.
void draw(const LeftBehind& run) {
  write_map_picture(run.out / "map.png",
                    {.map = run.result.map,
                     .truth = run.truth ? &run.truth->map : nullptr,
                     .trajectory = positions(run.result.T_world_lidar),
                     .cloud = run.recorder.cloud().in_world(run.result.T_world_lidar),
                     .tentative = run.result.tentative},
                    run.config.autonomy.objects);
}

void finish_recording(RunRecording& recording, const LeftBehind& run) {
  std::vector<Time> stamps;
  for (const autonomy::ScanRecord& scan : run.result.scans) stamps.push_back(scan.stamp);
  recording.finish(run.out, flight::viewers::site_of(run.config.autonomy, run.config.site.origin),
                   run.recorder.cloud().scans(stamps, run.result.T_world_lidar));
}

/// A warning where the network was not made for such a recording.
void say_fit(const autonomy::SegmentationFit& fit, const autonomy::Config& config) {
  const auto network = core::find_in_configs(config.segmentation.model, "segmentation.model");
  const std::string note =
      network_fit_note(fit, std::filesystem::path(network).replace_extension(".yaml"));
  if (!note.empty()) spdlog::warn("{}", note);
}

/// "drive" of "data/drive/".
std::string name_of(const std::string& path) {
  const auto whole = std::filesystem::absolute(path).lexically_normal();
  return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

int replay(const ReplayOptions& options, const CommonOptions& common) {
  const flight::ProcessConfig process = read_configuration(common);
  const autonomy::Config& config = process.autonomy;
  const auto record = record_file(options.record, common.force);
  const auto source = open_input(options);
  std::optional<Truth> truth;
  if (!options.truth.empty()) truth = read_truth(options.truth, config.objects);
  core::Timings timings;
  autonomy::Lockstep lockstep(config, common.threads, timings);
  const OutputFolder out(common);
  std::optional<RunRecording> recording;
  if (record) recording.emplace(*record, "R1");
  if (const std::string note = autonomy::noise_note(config, source->sensor_name()); !note.empty()) {
    spdlog::info("{}", note);
  }

  RunRecorder recorder(out.path(), config.objects);
  const auto start = std::chrono::steady_clock::now();
  WatchedSource watched(*source, timings, recording ? &*recording : nullptr);
  const autonomy::LockstepResult result = lockstep.run(watched, recorder);
  const double wall =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (result.scans.empty())
    throw Error(fmt::format("{}: no scan in it, expected at least one", options.input.path));

  say_fit(result.fit, config);
  recorder.write(result);
  nlohmann::json results = figures(result, wall, config.objects);
  results["source"] = source_figures(source->counters());
  results["detections"] = recorder.detections();
  const std::vector<std::string> short_of = shortfalls(result, recorder.detections());
  results["shortfalls"] = short_of;
  if (truth)
    results["trajectory"] =
        trajectory_figures(result.scans, result.T_world_lidar, truth->trajectory);
  core::write_file(out / "results.json", results.dump(2) + "\n");
  core::write_file(out / "timings.csv", timings.csv());
  const LeftBehind run{out.path(), process, result, recorder, truth};
  draw(run);
  if (recording) finish_recording(*recording, run);
  report(results);
  for (const std::string& line : short_of) spdlog::warn("{}", line);
  leave_html_report(out.path(), "Replay of " + name_of(options.input.path), process);
  return short_of.empty() ? 0 : 1;
}

}  // namespace

void add_replay(Commands& commands) {
  auto options = std::make_shared<ReplayOptions>();
  CLI::App& app =
      commands.add({.name = "replay",
                    .does = "the pipeline over a recording: trajectory and object map",
                    .output = Output::folder,
                    .example = "saker replay drive/ -o out --threads 2"},
                   [options](const CommonOptions& common) { return replay(*options, common); });
  add_recording_input(app, "INPUT", options->input);
  app.add_option("--format", options->format, "kitti, ouster or lcm; found out when not given")
      ->check(CLI::IsMember({"auto", "kitti", "ouster", "lcm"}));
  app.add_option("--truth", options->truth, "a truth.json: drawn into map.png, and compared with");
  app.add_option("--record", options->record,
                 "write scans, objects and poses into an MCAP file for viewers and saker replay")
      ->type_name("FILE");
}

}  // namespace saker::tools
