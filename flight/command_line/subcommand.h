#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "flight/command_line/configuration_source.h"

/// The frame of the command line. A subcommand is one file that defines one function
///
///     void add_scans(Commands& commands) {
///       auto options = std::make_shared<ScansOptions>();
///       CLI::App& app = commands.add(
///           {.name = "scans", .does = "decodes an Ouster capture", .output = Output::folder,
///            .example = "saker scans drive.pcap -o out"},
///           [options](const CommonOptions& common) { return scans(*options, common); });
///       app.add_option("CAPTURE", options->capture, "the capture (*.pcap)")->required();
///     }
///
/// and stands in tools/saker/CMakeLists.txt. What it returns is the exit status: 0 done, 1 done but
/// the result falls short; for wrong usage, input or configuration it throws Error (status 2).
namespace saker::flight {

/// What every subcommand takes.
struct CommonOptions {
  ConfigurationSource configuration;
  std::uint64_t seed = 1;
  int threads = 1;  ///< in all, at least 1
  bool verbose = false;
  std::string out;  ///< -o, for commands that have it
  bool force = false;
};

enum class Output { none, folder, optional_folder, file };

struct Description {
  std::string name;
  std::string does;
  Output output = Output::none;
  std::string example;
};

/// The subcommands, and which of them was called.
class Commands {
 public:
  using Run = std::function<int(const CommonOptions&)>;

  explicit Commands(CLI::App& app) : app_(app) {}

  /// Adds a subcommand with the common options; its own are added to what is returned.
  CLI::App& add(const Description& description, Run run) {
    return add(app_, description, std::move(run));
  }
  /// The same inside a group: add(commands.add_group("map", "object maps"), {.name = "info", …},
  /// …).
  CLI::App& add(CLI::App& parent, const Description& description, Run run);
  CLI::App& add_group(const std::string& name, const std::string& does);

  /// Runs the subcommand that was parsed, after `check`; its exit status.
  [[nodiscard]] int run(const std::function<void(const CommonOptions&)>& check) const;

  /// Name of what was called so far ("saker", "saker replay", "saker map info"), for messages.
  [[nodiscard]] std::string called() const;

 private:
  struct Command {
    CLI::App* app;
    std::shared_ptr<CommonOptions> common;
    Run run;
  };

  CLI::App& app_;
  std::vector<Command> commands_;
};

/// The whole program without the process: parses, checks what all commands share, runs, catches;
/// the exit status.
[[nodiscard]] int run_command_line(const std::vector<std::function<void(Commands&)>>& list,
                                   const std::function<void(const CommonOptions&)>& check, int argc,
                                   const char* const* argv);

}  // namespace saker::flight
