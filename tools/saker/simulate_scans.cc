#include <optional>

#include "saker/core/config_io.h"
#include "saker/core/error.h"
#include "saker/core/progress.h"
#include "saker/simulation/mission/flight.h"
#include "saker/simulation/mission/training.h"
#include "tools/saker/command.h"

namespace saker::tools {
namespace {

struct SimulateOptions {
  std::string scenario;
};

int simulate_scans(const SimulateOptions& options, const CommonOptions& common) {
  const auto scenario = core::load_config<simulation::Scenario>(options.scenario, {});
  if (scenario.kind == simulation::ScenarioKind::mission) {
    throw Error(options.scenario +
                ": kind: mission, expected training or flight: saker experiment flies missions");
  }
  if (scenario.kind == simulation::ScenarioKind::spiral) {
    throw Error(options.scenario +
                ": kind: spiral, expected training or flight: saker characterise flies spirals");
  }
  const OutputFolder out(common);
  std::optional<core::Progress> bar;
  const auto progress = [&](int done, int total) {
    if (!bar) bar.emplace("simulate-scans", total);
    bar->update(done);
  };
  if (scenario.kind == simulation::ScenarioKind::flight) {
    simulation::write_flight(scenario.flight, common.seed, out.path(), progress);
  } else {
    simulation::write_training_scans(scenario.training, common.seed, out.path(), progress,
                                     common.threads);
  }
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
