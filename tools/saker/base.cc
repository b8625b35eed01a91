#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <memory>

#include "flight/base_station/store.h"
#include "saker/exchange/key.h"
#include "tools/saker/command.h"
#include "tools/saker/configuration.h"

namespace saker::tools {
namespace {

struct BaseOptions {
  std::string store;
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

int make_key(const CommonOptions& common) {
  exchange::make_key_file(output_file(common.out, common.force));
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
  commands.add(group,
               {.name = "key",
                .does = "draws a key of the team, for every robot, the base and the ground",
                .output = Output::file,
                .example = "saker base key -o team.key"},
               make_key);
}

}  // namespace saker::tools
