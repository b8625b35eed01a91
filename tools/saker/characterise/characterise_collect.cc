#include <spdlog/spdlog.h>

#include "saker/core/config_io.h"
#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/core/progress.h"
#include "saker/objects/map_io.h"
#include "tools/saker/characterise/characterise.h"
#include "tools/saker/characterise/recorded_samples.h"
#include "tools/saker/command.h"
#include "tools/saker/configuration.h"

namespace saker::tools {
namespace {

struct CollectOptions {
  std::vector<std::string> runs;
  std::string truth;
  std::string dimensions;
};

KnownTruth read_known_truth(const CollectOptions& options, const objects::ClassTable& table) {
  KnownTruth truth;
  if (!options.truth.empty()) truth.map = objects::read_map(options.truth, table);
  if (!options.dimensions.empty()) {
    truth.dimensions = core::checked(core::load_config<DimensionsTable>(options.dimensions, {}),
                                     options.dimensions);
  }
  return truth;
}

int collect(const CollectOptions& options, const CommonOptions& common) {
  const objects::ClassTable table = read_configuration(common).autonomy.objects;
  const KnownTruth truth = read_known_truth(options, table);
  const std::filesystem::path file = output_file(common.out, common.force);
  core::Progress progress("characterise", static_cast<long>(options.runs.size()));
  std::vector<uncertainty::Sample> samples;
  for (std::size_t i = 0; i < options.runs.size(); ++i) {
    progress.update(static_cast<long>(i));
    const auto more = recorded_samples(options.runs[i], truth, table);
    samples.insert(samples.end(), more.begin(), more.end());
  }
  if (samples.empty()) {
    throw Error("no measurement of a known object in " + options.runs.front() +
                ", expected at least one");
  }
  core::write_file(file, uncertainty::samples_text(samples, table));
  spdlog::info("{} samples from {} recordings", samples.size(), options.runs.size());
  return 0;
}

}  // namespace

void add_characterise_collect(Commands& commands, CLI::App& group) {
  auto options = std::make_shared<CollectOptions>();
  CLI::App& app = commands.add(
      group,
      {.name = "collect",
       .does =
           "the same from recordings that were replayed or flown; the truth is a file, or sizes "
           "by hand, or else each run's converged map",
       .output = Output::file,
       .example = "saker characterise collect out -o samples.csv --dimensions dimensions.yaml"},
      [options](const CommonOptions& common) { return collect(*options, common); });
  app.add_option("RUN", options->runs,
                 "what saker replay left: detections.jsonl, trajectory.txt, map.json")
      ->required();
  CLI::Option* truth = app.add_option("--truth", options->truth,
                                      "true objects (truth.json), in the frame of the run's map");
  app.add_option("--dimensions", options->dimensions,
                 "lengths and widths by hand (*.yaml); places come from the run's map")
      ->excludes(truth);
}

}  // namespace saker::tools
