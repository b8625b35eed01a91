#include "flight/process/process.h"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <atomic>
#include <csignal>
#include <iostream>

#include "flight/process/service.h"

namespace saker::flight {
namespace {

constexpr int kInvalid = 2;  // usage, input or configuration

std::atomic<int> requests = 0;
static_assert(std::atomic<int>::is_always_lock_free);  // what a signal's handler may touch

void ready_signals() {
  struct sigaction action {};
  action.sa_handler = [](int) { ++requests; };
  sigaction(SIGTERM, &action, nullptr);
  sigaction(SIGINT, &action, nullptr);
}

/// The level of a line in front of it, for the journal (sd-daemon(3)); trace, debug … critical.
class JournalPriority : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm&,
              spdlog::memory_buf_t& line) override {
    constexpr std::string_view kPriorities[] = {"<7>", "<7>", "<6>", "<4>", "<3>", "<2>", "<2>"};
    const std::string_view priority = kPriorities[message.level];
    line.append(priority.data(), priority.data() + priority.size());
  }
  std::unique_ptr<custom_flag_formatter> clone() const override {
    return std::make_unique<JournalPriority>();
  }
};

constexpr const char* kPattern = "%H:%M:%S.%e %n %^%l%$ %v";

/// The journal knows time, name and level of a line by itself.
void set_form(spdlog::logger& logger) {
  if (!to_journal()) return logger.set_pattern(kPattern);
  auto form = std::make_unique<spdlog::pattern_formatter>();
  form->add_flag<JournalPriority>('*').set_pattern("%*%v");
  logger.set_formatter(std::move(form));
}

void ready_log(const std::string& name, bool verbose) {
  auto logger = std::make_shared<spdlog::logger>(
      name, std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
  logger->set_level(verbose ? spdlog::level::debug : spdlog::level::info);
  set_form(*logger);
  spdlog::set_default_logger(std::move(logger));
}

int refuse(const std::string& name, const std::string& what) {
  std::cerr << journal_error() << name << ": " << what << std::endl;
  return kInvalid;
}

}  // namespace

void log_above_a_line(bool room) {
  const auto logger = spdlog::default_logger();
  spdlog::sinks::sink& terminal = *logger->sinks().front();
  const bool verbose = logger->level() <= spdlog::level::debug;
  terminal.set_level(room && !verbose ? spdlog::level::warn : spdlog::level::trace);
  terminal.set_pattern(room ? std::string("\r\033[K") + kPattern : kPattern);
}

int stop_requests() { return requests; }

int run_program(const Program& program, int argc, const char* const* argv) {
  ProcessOptions options{.robot = program.robot, .configuration = {}};
  CLI::App app(program.does, program.name);
  app.add_option("--robot", options.robot, "name of the robot, first part of its channels")
      ->type_name("NAME")
      ->capture_default_str();
  add_configuration_options(app, options.configuration);
  app.add_flag("-v,--verbose", options.verbose, "log debug lines too");
  program.add_options(app);
  app.footer("Example: " + program.name + " --robot " + program.robot);
  try {
    app.parse(argc, argv);
    ready_signals();
    ready_log(program.name, options.verbose);
    return program.run(options);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    return refuse(program.name, std::string(error.what()) + " (see --help)");
  } catch (const std::exception& error) {
    return refuse(program.name, error.what());
  }
}

}  // namespace saker::flight
