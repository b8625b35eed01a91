#include "flight/command_line/subcommand.h"

#include <fmt/format.h>

#include <iostream>
#include <thread>

#include "flight/command_line/output.h"
#include "saker/core/error.h"

namespace saker::flight {
namespace {

constexpr int kInvalid = 2;  // usage, input or configuration

int default_threads() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

void add_common(CLI::App& app, CommonOptions& common, Output output) {
  common.threads = default_threads();
  add_configuration_options(app, common.configuration);
  app.add_option("--seed", common.seed, "of all random numbers; 1 where it is not given")
      ->type_name("N");
  app.add_option("--threads", common.threads, "in all; results do not depend on it")
      ->type_name("N")
      ->check(CLI::Range(1, 256));
  app.add_flag("-v,--verbose", common.verbose, "log debug lines too");
  if (output == Output::none) return;
  const bool folder = output != Output::file;
  app.add_option("-o,--out", common.out,
                 folder ? "folder for the results, made if need be" : "file to write")
      ->type_name(folder ? "OUT" : "FILE")
      ->required(output != Output::optional_folder);
  app.add_flag("--force", common.force, "replace results that are there");
}

int refuse(const Commands& commands, const std::string& what) {
  std::cerr << commands.called() << ": " << what << std::endl;
  return kInvalid;
}

int parse_and_run(CLI::App& app, const Commands& commands,
                  const std::function<void(const CommonOptions&)>& check, int argc,
                  const char* const* argv) {
  try {
    app.parse(argc, argv);
    return commands.run(check);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    return refuse(commands, fmt::format("{} (see --help)", error.what()));
  } catch (const std::bad_alloc&) {
    return refuse(commands, "not enough memory");
  } catch (const std::exception& error) {
    return refuse(commands, error.what());
  }
}

}  // namespace

CLI::App& Commands::add_group(const std::string& name, const std::string& does) {
  CLI::App& group = *app_.add_subcommand(name, does);
  group.require_subcommand(1);
  return group;
}

CLI::App& Commands::add(CLI::App& parent, const Description& description, Run run) {
  CLI::App& app = *parent.add_subcommand(description.name, description.does);
  app.footer("Example:\n  " + description.example);
  auto common = std::make_shared<CommonOptions>();
  add_common(app, *common, description.output);
  commands_.push_back({&app, std::move(common), std::move(run)});
  return app;
}

int Commands::run(const std::function<void(const CommonOptions&)>& check) const {
  for (const Command& command : commands_) {
    if (!command.app->parsed()) continue;
    start_logging(command.common->verbose);
    check(*command.common);
    return command.run(*command.common);
  }
  throw Error("no subcommand");  // not reached: the parser requires one
}

std::string Commands::called() const {
  std::string name = app_.get_name();
  for (const CLI::App* app = &app_; !app->get_subcommands().empty();) {
    app = app->get_subcommands().front();
    name += " " + app->get_name();
  }
  return name;
}

int run_command_line(const std::vector<std::function<void(Commands&)>>& list,
                     const std::function<void(const CommonOptions&)>& check, int argc,
                     const char* const* argv) {
  CLI::App app("Saker: from LiDAR to a map of objects", "saker");
  app.require_subcommand(1);
  app.set_version_flag("--version", SAKER_VERSION);
  Commands commands(app);
  for (const auto& add : list) add(commands);
  return parse_and_run(app, commands, check, argc, argv);
}

}  // namespace saker::flight
