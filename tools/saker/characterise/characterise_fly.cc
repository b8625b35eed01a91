#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <future>
#include <map>
#include <nlohmann/json.hpp>

#include "saker/core/config_io.h"
#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/core/parallel.h"
#include "saker/core/progress.h"
#include "saker/simulation/mission/scenario.h"
#include "tools/saker/characterise/characterise.h"
#include "tools/saker/characterise/spiral_samples.h"
#include "tools/saker/command.h"
#include "tools/saker/configuration.h"

namespace saker::tools {
namespace {

namespace fs = std::filesystem;

/// Vehicles, whose measurements depend on most, get most of the flights.
const std::vector<std::string> kSubjects = {"vehicle", "vehicle", "vehicle",
                                            "vehicle", "trunk",   "pole"};

struct FlyOptions {
  int objects = 60;
  std::vector<std::string> classes = {"vehicle", "trunk", "pole"};
  std::string scenario;  ///< empty: the default spiral
};

struct Flight {
  simulation::SpiralSubject subject;
  std::uint64_t seed = 0;
  std::string recording;
  fs::path samples, glances;  ///< where they go; the samples are written last
};

simulation::SpiralConfig read_spiral(const FlyOptions& options) {
  if (options.scenario.empty()) return {};
  const auto scenario = core::load_config<simulation::Scenario>(options.scenario, {});
  if (scenario.kind == simulation::ScenarioKind::spiral) return scenario.spiral;
  throw Error(fmt::format("{}: kind: expected spiral", options.scenario));
}

/// The classes in turn, each through its kinds; a flight follows from the seed and its number.
std::vector<Flight> flights_of(const FlyOptions& options, std::uint64_t seed, const fs::path& out) {
  std::vector<std::string> turns;
  for (const std::string& name : kSubjects) {
    if (std::ranges::count(options.classes, name) > 0) turns.push_back(name);
  }
  std::map<std::string, int> flown;
  std::vector<Flight> flights;
  for (int i = 0; i < options.objects; ++i) {
    const std::string& name = turns[static_cast<std::size_t>(i) % turns.size()];
    core::Rng rng = core::Rng(seed).fork(static_cast<std::uint64_t>(i));
    const std::string stem = fmt::format("{:05}", i);
    flights.push_back({{name, flown[name]++},
                       static_cast<std::uint64_t>(rng.index(1 << 30)),
                       fmt::format("seed{}-{}", seed, stem),
                       out / "flights" / (stem + ".csv"),
                       out / "flights" / (stem + "-coverage.csv")});
  }
  return flights;
}

/// What must be the same for interrupted flights to go on.
std::string manifest(const FlyOptions& options, const CommonOptions& common) {
  const nlohmann::json all = {{"objects", options.objects},
                              {"classes", options.classes},
                              {"seed", common.seed},
                              {"spiral", core::config_to_yaml(read_spiral(options))},
                              {"configuration", configuration_text(read_configuration(common))}};
  return all.dump(1) + "\n";
}

void fly_one(const Flight& flight, const simulation::SpiralConfig& spiral,
             const autonomy::Config& config) {
  const SpiralSamples result =
      fly_spiral(spiral, flight.subject, flight.seed, config, flight.recording);
  core::write_file(flight.glances, glances_text(result.glances, config.objects));
  core::write_file(flight.samples, uncertainty::samples_text(result.samples, config.objects));
}

/// Side by side those that are not finished.
void fly_all(const std::vector<Flight>& flights, const simulation::SpiralConfig& spiral,
             const autonomy::Config& config, int threads) {
  core::Progress progress("characterise", static_cast<long>(flights.size()));
  std::vector<std::future<void>> done;
  core::TaskThreads pool(threads);
  for (const Flight& flight : flights) {
    if (fs::exists(flight.samples)) continue;
    auto task = std::make_shared<std::packaged_task<void()>>(
        [&flight, &spiral, &config] { fly_one(flight, spiral, config); });
    done.push_back(task->get_future());
    pool.push([task] { (*task)(); });
  }
  long finished = static_cast<long>(flights.size() - done.size());
  progress.update(finished);
  for (std::future<void>& flight : done) {
    flight.get();
    progress.update(++finished);
  }
}

/// The files one after another, under the header of the first.
std::string joined(const std::vector<Flight>& flights, fs::path Flight::*file) {
  std::string all;
  for (const Flight& flight : flights) {
    const std::string text = core::read_file(flight.*file);
    all += all.empty() ? text : text.substr(text.find('\n') + 1);
  }
  return all;
}

int fly(const FlyOptions& options, const CommonOptions& common) {
  const autonomy::Config config = read_configuration(common).autonomy;
  const simulation::SpiralConfig spiral = core::checked(read_spiral(options), "spiral");
  const std::string wanted = manifest(options, common);
  const fs::path manifest_file = fs::path(common.out) / "characterise.json";
  CommonOptions outer = common;
  const bool same = fs::exists(manifest_file) && core::read_file(manifest_file) == wanted;
  outer.force = common.force || same;
  const OutputFolder out(outer);
  const std::vector<Flight> flights = flights_of(options, common.seed, out.path());
  if (common.force) fs::remove_all(out.path() / "flights");
  (void)out.folder("flights");
  core::write_file(manifest_file, wanted);

  fly_all(flights, spiral, config, common.threads);
  core::write_file(out / "coverage.csv", joined(flights, &Flight::glances));
  const std::string samples = joined(flights, &Flight::samples);
  core::write_file(out / "samples.csv", samples);
  spdlog::info("{} flights, {} samples", flights.size(), std::ranges::count(samples, '\n') - 1);
  return 0;
}

}  // namespace

void add_characterise_fly(Commands& commands, CLI::App& group) {
  auto options = std::make_shared<FlyOptions>();
  CLI::App& app = commands.add(
      group,
      {.name = "fly",
       .does = "spirals about single objects, simulated: their measurements beside the truth; goes "
               "on where it was interrupted",
       .output = Output::folder,
       .example = "saker characterise fly -o train --objects 90 --threads 2"},
      [options](const CommonOptions& common) { return fly(*options, common); });
  app.add_option("--objects", options->objects, "flights, each about another object")
      ->check(CLI::Range(1, 99999))
      ->capture_default_str();
  app.add_option("--classes", options->classes, "what to fly about, separated by commas")
      ->delimiter(',')
      ->check(CLI::IsMember({"vehicle", "trunk", "pole"}))
      ->capture_default_str();
  app.add_option("--scenario", options->scenario,
                 "sensor and spirals (*.yaml, kind spiral); OS1-64 at 512x10 when not given");
}

}  // namespace saker::tools
