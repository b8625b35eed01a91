#include "core/error.h"
#include "core/progress.h"
#include "saker/output.h"
#include "saker/subcommand.h"
#include "simulation/scenario_file.h"
#include "simulation/training.h"

namespace saker::tools {
namespace {

struct SimulateOptions {
  std::string scenario;
};

int simulate_scans(const SimulateOptions& options, const CommonOptions& common) {
  const simulation::Scenario scenario = simulation::load_scenario(options.scenario);
  const OutputFolder out(common);
  const int total = scenario.training.worlds * scenario.training.scans_per_world;
  core::Progress progress("simulate-scans", total);
  simulation::write_training_scans(scenario.training, common.seed, out.path(),
                                   [&](int done, int) { progress.update(done); });
  return 0;
}

}  // namespace

void add_simulate_scans(Commands& commands) {
  auto options = std::make_shared<SimulateOptions>();
  CLI::App& app = commands.add(
      {.name = "simulate-scans",
       .does = "ray-casts labelled scans and captures of made worlds",
       .output = Output::folder,
       .example = "saker simulate-scans configs/scenarios/training.yaml -o scans --seed 3"},
      [options](const CommonOptions& common) { return simulate_scans(*options, common); });
  app.add_option("SCENARIO", options->scenario, "what to simulate (*.yaml)")->required();
}

}  // namespace saker::tools
