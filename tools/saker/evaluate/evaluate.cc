#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <span>

#include "flight/run_files/detections_file.h"
#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/core/progress.h"
#include "saker/lidar/recording.h"
#include "saker/objects/map_io.h"
#include "saker/segmentation/segmentation.h"
#include "tools/saker/command.h"
#include "tools/saker/configuration.h"
#include "tools/saker/evaluate/evaluation.h"
#include "tools/saker/evaluate/labelled_folder.h"
#include "tools/saker/evaluate/piece_table.h"
#include "tools/saker/evaluate/vehicle_figures.h"
#include "tools/saker/evaluate/window_figures.h"

namespace saker::tools {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct EvaluateOptions {
  std::string folder;
  std::string metadata;
  std::string run;  ///< what `saker replay` left, or empty
  double label_sd_m = 0.1;
  bool pieces = false;
};

/// OUT/cylinders.csv and vehicles.csv.
class PieceFiles {
 public:
  PieceFiles(const OutputFolder& out, const objects::ClassTable& table)
      : table_(table), figures_(table) {
    for (const segmentation::PieceFamily family : segmentation::kPieceFamilies) {
      const std::string name = segmentation::info_of(family).name;
      files_.try_emplace(family, out / (name + ".csv")).first->second.write(piece_header(family));
    }
  }
  void add(const lidar::Frame& frame, std::span<const std::uint32_t> ids,
           segmentation::Segmentation& stage) {
    for (const auto& piece : stage.pieces(frame.scan)) {
      files_.at(piece.family).write(piece_row(frame.name, piece, ids, figures_, table_));
    }
  }
  void finish() {
    for (auto& [family, file] : files_) file.finish();
  }

 private:
  std::map<segmentation::PieceFamily, core::OutputFile> files_;
  const objects::ClassTable& table_;
  SegmentationFigures figures_;
};

/// Segments and judges every labelled scan of the folder. \param pieces  or null.
void evaluate_scans(const EvaluateOptions& options, segmentation::Segmentation& stage,
                    Evaluation& evaluation, PieceFiles* pieces) {
  const LabelledFolder truth(options.folder);
  const auto source =
      lidar::open_recording(options.folder, lidar::RecordingFormat::kAutomatic, options.metadata);
  core::Progress progress("evaluate", source->expected_scans());
  int done = 0;
  while (const auto frame = source->next()) {
    progress.update(done++);
    if (!frame->fault.empty()) {
      spdlog::warn("{}: {}", frame->name, frame->fault);
      continue;
    }
    const auto ids = truth.ids(frame->name, frame->scan.size());
    const auto* boxes = truth.boxes(frame->name);
    if (!ids && boxes == nullptr) continue;
    if (pieces != nullptr && ids) pieces->add(*frame, *ids, stage);
    const auto start = std::chrono::steady_clock::now();
    const lidar::Labels labels = stage.segment(frame->scan);
    const std::chrono::duration<double, std::milli> ms = std::chrono::steady_clock::now() - start;
    evaluation.add(frame->name, frame->scan, labels, ids ? &*ids : nullptr, boxes,
                   truth.half_angle_deg(frame->name), ms.count());
  }
  if (evaluation.scans() == 0) {
    throw Error(options.folder + ": no scan that could be read is labelled");
  }
}

Json segmentation_figures(const EvaluateOptions& options, const CommonOptions& common,
                          const std::optional<OutputFolder>& out) {
  const autonomy::Config config = read_configuration(common).autonomy;
  segmentation::Segmentation stage(config.segmentation, config.objects);
  Evaluation evaluation(config.objects);
  std::optional<PieceFiles> pieces;
  if (options.pieces) pieces.emplace(*out, config.objects);
  evaluate_scans(options, stage, evaluation, pieces ? &*pieces : nullptr);
  if (pieces) pieces->finish();
  const Json figures = evaluation.json();
  std::cout << evaluation_text(figures);
  if (!out) return figures;
  for (const EvaluatedScan& scan : evaluation.worst()) {
    write_evaluation_picture(*out / ("missed_" + scan.name + ".png"), scan);
  }
  return figures;
}

Json vehicle_json(const VehicleResult& v) {
  Json row = {{"track", v.track}, {"found", v.found}};
  if (!v.found) return row;
  const auto number = [](double value) {
    return std::isfinite(value) ? Json(std::nearbyint(value * 1000) / 1000) : Json();
  };
  row.update(Json{{"position_m", number(v.position_error_m)},
                  {"length_error_m", number(v.length_error_m)},
                  {"width_error_m", number(v.width_error_m)},
                  {"yaw_error_deg", number(v.heading_error_deg)},
                  {"front_right", v.front_right},
                  {"duplicates", v.duplicates},
                  {"size_nees", number(v.size_nees)},
                  {"place_nees", number(v.place_nees)}});
  return row;
}

/// The map and the windows of a run over the folder's scans, against the folder's vehicles.json.
Json map_figures(const EvaluateOptions& options, const CommonOptions& common) {
  const autonomy::Config config = read_configuration(common).autonomy;
  const objects::ClassTable& table = config.objects;
  const LabelledVehicles labelled =
      read_labelled_vehicles(fs::path(options.folder) / "vehicles.json");
  const fs::path run = options.run;
  const objects::ObjectMap map = objects::read_map(run / "map.json", table);
  const auto poses = read_trajectory(run / "trajectory.txt");
  const VehicleFigures vehicles = vehicle_figures(map, table, poses, labelled, options.label_sd_m);
  Json figures = vehicles.json();
  for (const auto& [key, value] : figures.items()) {
    std::cout << fmt::format("{:26} {}\n", key, value.dump());
  }
  figures["label_sd_m"] = options.label_sd_m;
  figures["vehicles"] = Json::array();
  for (const VehicleResult& v : vehicles.vehicles) figures["vehicles"].push_back(vehicle_json(v));
  const std::vector<WindowResult> windows = window_results(
      flight::read_detections(run / "detections.jsonl", table), table, poses, labelled);
  const Eigen::Vector2d box(table[table.first_target()].size_m.data());
  figures["windows"] = window_json(windows, box);
  std::cout << window_text(figures["windows"]);
  return figures;
}

int evaluate(const EvaluateOptions& options, const CommonOptions& common) {
  if (!fs::is_directory(options.folder)) {
    throw Error(options.folder + ": no such folder");
  }
  std::optional<OutputFolder> out;
  if (!common.out.empty()) out.emplace(common);
  if (options.pieces && !out) throw Error("--pieces: expected -o OUT beside it");
  const Json figures = options.run.empty() ? segmentation_figures(options, common, out)
                                           : map_figures(options, common);
  if (out) core::write_file(*out / "evaluation.json", figures.dump(1) + "\n");
  return 0;
}

}  // namespace

void add_evaluate(Commands& commands) {
  auto options = std::make_shared<EvaluateOptions>();
  CLI::App& app = commands.add(
      {.name = "evaluate",
       .does = "labelled scans: how well they are segmented, and pictures of what was missed",
       .output = Output::optional_folder,
       .example = "saker evaluate drive -o out"},
      [options](const CommonOptions& common) { return evaluate(*options, common); });
  app.add_option("FOLDER", options->folder,
                 "scans (velodyne/*.bin, or an Ouster capture) with labels/STEM.label, boxes.json "
                 "or both")
      ->required();
  app.add_option("--meta", options->metadata, "metadata (JSON) of a capture; else beside it")
      ->type_name("FILE");
  app.add_option("--map", options->run,
                 "judge the map and the single windows that saker replay left in this folder by "
                 "FOLDER/vehicles.json")
      ->type_name("RUN");
  app.add_flag(
      "--pieces", options->pieces,
      "also OUT/cylinders.csv and vehicles.csv: what tells pieces apart, by what is labelled "
      "(scripts/segmentation-fit)");
  app.add_option("--label-sd", options->label_sd_m,
                 "of a labelled length and width, m, twice that of its centre: part of the NEES")
      ->type_name("M")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
}

}  // namespace saker::tools
