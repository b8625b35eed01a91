#include <fmt/format.h>

#include "flight/viewers/recording.h"
#include "saker/core/error.h"
#include "tools/saker/command.h"
#include "tools/saker/configuration.h"

namespace saker::tools {
namespace {

struct ConvertOptions {
  std::string run, out;
  bool force = false;
};

int convert(const ConvertOptions& options, const CommonOptions& common) {
  const std::filesystem::path out = output_file(options.out, options.force);
  if (out.extension() != ".mcap")
    throw Error("cannot write " + out.string() + ": expected a name that ends in .mcap");
  const flight::ProcessConfig config = read_configuration(common);
  const auto site = flight::viewers::site_of(config.autonomy, config.site.origin);
  const auto run = flight::viewers::open_run(options.run, site);
  const std::uint64_t messages = flight::viewers::record_run(*run, site, out);
  fmt::print("{}: {} messages over {:.1f} s\n", out.string(), messages,
             run->end_s() - run->begin_s());
  return 0;
}

}  // namespace

void add_convert(Commands& commands) {
  auto options = std::make_shared<ConvertOptions>();
  CLI::App& app = commands.add(
      {.name = "convert",
       .does = "a run or a log into an MCAP file for viewers; scans in it are read by saker replay",
       .example = "saker convert flight.lcmlog flight.mcap"},
      [options](const CommonOptions& common) { return convert(*options, common); });
  app.add_option("LOG", options->run,
                 "a folder of saker replay, experiment, mission or of saker-flight, or a log of "
                 "lcm-logger")
      ->required();
  app.add_option("OUT", options->out, "the file (*.mcap)")->required();
  app.add_flag("--force", options->force, "replace OUT");
}

}  // namespace saker::tools
