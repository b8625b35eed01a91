#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "flight/command_line/configuration_source.h"

namespace saker::flight {

/// What every process is started with.
struct ProcessOptions {
  std::string robot = "R1";
  ConfigurationSource configuration;
  bool verbose = false;
};

struct Program {
  std::string name;          ///< saker-flight, …
  std::string does;          ///< one line, for --help
  std::string robot = "R1";  ///< its name where --robot does not say it
  /// Options of its own.
  std::function<void(CLI::App&)> add_options = [](CLI::App&) {};
  /// Runs until `stop_requests`; its result is the exit status.
  std::function<int(const ProcessOptions&)> run;
};

/// `main` of a process: command line, log to stderr, SIGTERM and SIGINT. What `run` throws is one
/// line on stderr and status 2.
[[nodiscard]] int run_program(const Program& program, int argc, const char* const* argv);

/// Whether the log leaves room for a line on the terminal that is rewritten: what is below a
/// warning goes to the log's file alone, unless the process was started with -v. To be called where
/// stderr is a terminal and the log has a file.
void log_above_a_line(bool room);

/// How often SIGTERM or SIGINT came.
[[nodiscard]] int stop_requests();

}  // namespace saker::flight
