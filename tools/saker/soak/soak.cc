#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>

#include "flight/process/loop_report.h"
#include "saker/autonomy/local_checker.h"
#include "saker/autonomy/mission_lockstep.h"
#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/core/progress.h"
#include "tools/plant/simulated_plant.h"
#include "tools/saker/command.h"
#include "tools/saker/configuration.h"
#include "tools/saker/experiment/mission_run.h"
#include "tools/saker/mission/team_mission.h"
#include "tools/saker/soak/soak_report.h"

namespace saker::tools {
namespace {

namespace fs = std::filesystem;

constexpr double kHour_s = 3600;

struct SoakOptions {
  std::string scenario;
  std::string samples;  ///< a file: no flight
  double hours = 3;
  int worlds = 4;
  double most_s = 600;
};

/// The most that waits between the stages, while a mission is flown.
class QueueWatch : public autonomy::MissionObserver {
 public:
  void look_at(const autonomy::MissionLockstep& mission) { mission_ = &mission; }
  void on_setpoint(const Setpoint&, const VehicleOdometry&) override {
    most_ = std::max(most_, mission_->waiting());
  }
  [[nodiscard]] std::size_t most() const { return most_; }

 private:
  const autonomy::MissionLockstep* mission_ = nullptr;
  std::size_t most_ = 0;
};

struct Flown {
  double seconds = 0;
  std::size_t waiting = 0;
};

/// A mission like any other; nothing of it stays.
Flown fly_once(const simulation::MissionConfig& site, const autonomy::Config& given,
               std::uint64_t seed, int threads, double most_s) {
  simulation::SimulatedVehicle vehicle(site, seed);
  const autonomy::Config config = at_site(given, site, vehicle.site().fence);
  SimulatedPlant plant(vehicle);
  autonomy::LocalChecker checker(config.local_checker, config.collision_checker,
                                 config.motion.clearance);
  core::Timings timings;
  QueueWatch watch;
  autonomy::MissionLockstep mission(config, vehicle.sensor(), vehicle.site().prior, plant, checker,
                                    threads, timings);
  watch.look_at(mission);
  const Time begin = vehicle.now();
  const autonomy::MissionResult result = mission.run(most_s, watch);
  if (!result.succeeded) spdlog::warn("seed {}: {}", seed, to_string(result.outcome));
  return {to_seconds(vehicle.now() - begin), watch.most()};
}

/// Missions until they have flown for so long, each sample on the disk before the next begins.
std::vector<SoakSample> fly_on(const SoakOptions& options, const CommonOptions& common,
                               const fs::path& file) {
  const simulation::MissionConfig site = read_site(options.scenario);
  const autonomy::Config config = read_configuration(common).autonomy;
  core::Progress progress("minutes of flight", std::lround(60 * options.hours));
  std::vector<SoakSample> samples;
  std::string lines;
  double flown_s = 0;
  for (std::uint64_t i = 0; flown_s < kHour_s * options.hours; ++i) {
    const double cpu_s = flight::process_seconds();
    const std::uint64_t seed = common.seed + i % static_cast<std::uint64_t>(options.worlds);
    const Flown flown = fly_once(site, config, seed, common.threads, options.most_s);
    flown_s += flown.seconds;
    SoakSample sample = sample_of_this_process(flown_s / kHour_s);
    sample.waiting = static_cast<double>(flown.waiting);
    sample.work = (flight::process_seconds() - cpu_s) / flown.seconds;
    samples.push_back(sample);
    lines += to_line(sample);
    core::write_file(file, lines);
    progress.update(std::lround(flown_s / 60));
  }
  return samples;
}

int soak(const SoakOptions& options, const CommonOptions& common) {
  if (options.scenario.empty() == options.samples.empty()) {
    throw Error("expected either a SCENARIO or --samples FILE");
  }
  std::vector<SoakSample> samples;
  if (!options.samples.empty())
    samples = read_samples(options.samples);  // bad ones leave no folder
  const OutputFolder out(common);
  if (options.samples.empty()) samples = fly_on(options, common, out / "soak.jsonl");
  const std::vector<SoakFigures> figures = figures_of(samples);
  const std::string table = soak_table(figures);
  core::write_file(out / "table.txt", table);
  write_soak_picture(out / "memory.svg", samples);
  std::cout << table;
  bool well = true;
  for (const SoakFigures& each : figures) {
    if (const std::string why = each.shortfall(); !why.empty()) {
      spdlog::error("{}", why);
      well = false;
    }
  }
  return well ? 0 : 1;
}

}  // namespace

void add_soak(Commands& commands) {
  auto options = std::make_shared<SoakOptions>();
  CLI::App& app = commands.add(
      {.name = "soak",
       .does = "many missions in lockstep, one after the other, in one process: whether memory or "
               "open handles grow",
       .output = Output::folder,
       .example = "saker soak configs/scenarios/small.yaml -o out --hours 3"},
      [options](const CommonOptions& common) { return soak(*options, common); });
  app.add_option("SCENARIO", options->scenario, "what to fly in (*.yaml, kind mission)");
  app.add_option("--hours", options->hours, "of simulated flight, all missions together")
      ->check(CLI::Range(0.001, 1000.0));
  app.add_option("--worlds", options->worlds, "seeds in turns: --seed and those that follow")
      ->check(CLI::Range(1, 100000));
  app.add_option("--seconds", options->most_s, "of a mission at most")
      ->check(CLI::Range(1.0, 86400.0));
  app.add_option("--samples", options->samples,
                 "instead of flying: the samples (*.jsonl) of processes, by scripts/soak");
}

}  // namespace saker::tools
