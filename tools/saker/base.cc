#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <memory>

#include "flight/base_station/store.h"
#include "saker/core/error.h"
#include "saker/exchange/key.h"
#include "tools/saker/command.h"
#include "tools/saker/configuration.h"

namespace saker::tools {
namespace {

struct BaseOptions {
  std::string store, robot;
  bool renew = false;
};

std::string when(const std::optional<std::int64_t>& utime) {
  if (!utime) return "never";
  const std::chrono::sys_time<std::chrono::microseconds> heard{std::chrono::microseconds(*utime)};
  const auto ago =
      std::chrono::duration_cast<std::chrono::seconds>(std::chrono::system_clock::now() - heard);
  return fmt::format("{:%F %T} UTC, {} s ago",
                     fmt::gmtime(std::chrono::system_clock::to_time_t(
                         std::chrono::time_point_cast<std::chrono::seconds>(heard))),
                     ago.count());
}

void print_row(const std::string& robot, const flight::StoredStream& stream,
               const std::string& heard) {
  const std::string kind = enum_names(stream.id.kind).at(static_cast<std::size_t>(stream.id.kind));
  fmt::print("{:<16}  {:<11}  {:>7}  {:>11}  {:>4}  {}\n", robot, kind, stream.id.version,
             stream.bytes, stream.gaps, heard);
}

void print_robot(const flight::StoreReport::Robot& robot) {
  const std::string heard = when(robot.heard_utime);
  if (robot.streams.empty()) fmt::print("{:<16}  {:<39}  {}\n", robot.name, "nothing yet", heard);
  for (const flight::StoredStream& stream : robot.streams) print_row(robot.name, stream, heard);
}

int status(const BaseOptions& options, const CommonOptions& common) {
  const std::string file =
      options.store.empty() ? store_file(read_configuration(common).base) : options.store;
  const flight::StoreReport report = flight::read_report(file);
  std::size_t streams = 0, bytes = 0;
  fmt::print("{:<16}  {:<11}  {:>7}  {:>11}  {:>4}  {}\n", "robot", "kind", "version", "bytes",
             "gaps", "last contact");
  for (const flight::StoreReport::Robot& robot : report.robots) {
    print_robot(robot);
    streams += robot.streams.size();
    for (const flight::StoredStream& stream : robot.streams) bytes += stream.bytes;
  }
  fmt::print("{} robots, {} streams, {} bytes; {} has {} bytes\n", report.robots.size(), streams,
             bytes, file, report.file_bytes);
  return 0;
}

int make_key(const BaseOptions& options, const CommonOptions& common) {
  const auto file = output_file(common.out, common.force);
  if (options.robot.empty()) {
    if (options.renew) throw Error("--renew, expected with --robot NAME");
    exchange::make_key_file(file);
    return 0;
  }
  const std::string team_file = read_configuration(common).exchange.key_file;
  if (options.renew) {
    exchange::renew_key(team_file, options.robot, file);
  } else {
    const auto existing = common.force ? exchange::Existing::replaced : exchange::Existing::refused;
    exchange::make_robot_key_file(exchange::read_key(team_file), options.robot, file, existing);
  }
  return 0;
}

}  // namespace

void add_base(Commands& commands) {
  auto options = std::make_shared<BaseOptions>();
  CLI::App& group = commands.add_group("base", "the base station: what it holds, the team's key");
  CLI::App& app = commands.add(
      group,
      {.name = "status",
       .does =
           "robots, their streams with version (flight) and bytes without a gap, chunks held "
           "beyond the first gap, and when each robot was heard last; also while saker-base runs",
       .output = Output::none,
       .example = "saker base status --store /var/lib/saker/base.db"},
      [options](const CommonOptions& common) { return status(*options, common); });
  app.add_option("--store", options->store, "the store; without it that of the configuration")
      ->type_name("FILE");
  CLI::App& key = commands.add(
      group,
      {.name = "key",
       .does = "draws the team's key, which stays at the base; with --robot: writes that robot's "
               "own, which follows from the team's (exchange.key_file)",
       .output = Output::file,
       .example = "saker base key -o team.key && saker base key --robot R1 -o R1.key"},
      [options](const CommonOptions& common) { return make_key(*options, common); });
  key.add_option("--robot", options->robot, "the robot whose key it is")->type_name("NAME");
  key.add_flag("--renew", options->renew,
               "a new one: those before are worth nothing once saker-base was restarted (a lost "
               "robot, a replaced disk)");
}

}  // namespace saker::tools
