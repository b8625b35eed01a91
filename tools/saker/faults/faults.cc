#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <future>
#include <iostream>
#include <map>
#include <memory>

#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/core/parallel.h"
#include "saker/core/progress.h"
#include "tools/saker/command.h"
#include "tools/saker/configuration.h"
#include "tools/saker/faults/fault_flight.h"
#include "tools/saker/faults/shrink.h"
#include "tools/saker/mission/team_mission.h"

namespace saker::tools {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct FaultsOptions {
  std::string scenario;
  int runs = 20;
  double most_s = 90;
  int tries = 12;      ///< flights that look for the fewest faults
  std::string replay;  ///< a record
};

FaultFlight flight_of(const FaultsOptions& options, const CommonOptions& common) {
  FaultFlight flight;
  flight.scenario = fs::path(options.scenario).stem();
  flight.site = read_site(options.scenario);
  flight.config = read_configuration(common).autonomy;
  flight.most_s = options.most_s;
  return flight;
}

/// World and faults follow from the seed.
FaultFlight drawn(FaultFlight flight, std::uint64_t seed) {
  flight.seed = seed;
  core::Rng rng = core::Rng(seed).fork(59);
  flight.schedule = draw_faults(rng, flight.most_s);
  return flight;
}

Json read_record(const fs::path& file) {
  try {
    return Json::parse(core::read_file(file));
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{}: no record of a flight: {}", file.string(), error.what()));
  }
}

/// The fewest faults that break the same, in the record of a broken flight.
Json with_fewest(const FaultFlight& flight, const FaultOutcome& outcome, int tries) {
  const Invariant invariant = outcome.breaches.front().invariant;
  const auto breaks = [&](const FaultSchedule& schedule) {
    FaultFlight tried = flight;
    tried.schedule = schedule;
    return std::ranges::any_of(fly_with_faults(tried).breaches,
                               [&](const Breach& breach) { return breach.invariant == invariant; });
  };
  Json record = outcome.record;
  record["fewest"] = to_json(shrunk(flight.schedule, breaks, tries));
  return record;
}

/// The record of one flight, from OUT where it is there.
Json flown(FaultFlight flight, const fs::path& out, int tries) {
  const fs::path file = out / fmt::format("{:06}.json", flight.seed);
  if (fs::exists(file)) return read_record(file);
  flight.files = out / fmt::format("{:06}.files", flight.seed);
  const FaultOutcome outcome = fly_with_faults(flight);
  core::write_file(file, outcome.record.dump(1) + "\n");
  if (outcome.breaches.empty() || tries == 0) return outcome.record;
  const Json record = with_fewest(flight, outcome, tries);
  core::write_file(file, record.dump(1) + "\n");
  return record;
}

void say(const Json& record) {
  const auto seed = record.at("seed").get<std::uint64_t>();
  for (const Json& breach : record.at("breaches")) {
    spdlog::error("seed {}: {} broken at {:.2f} s: {}", seed,
                  breach.at("invariant").get<std::string>(), breach.at("at_s").get<double>(),
                  breach.at("text").get<std::string>());
  }
  if (!record.contains("fewest")) return;
  for (const Fault& fault : faults_from_json(record.at("fewest"), "fewest")) {
    spdlog::error("seed {}: {}", seed, text_of(fault));
  }
}

/// How often each kind was flown, and what broke.
std::string table_of(const std::vector<Json>& records) {
  std::map<std::string, int> flights, broken;
  int bad = 0, succeeded = 0;
  for (const Json& record : records) {
    const bool breaks = !record.at("breaches").empty();
    bad += breaks;
    succeeded += record.at("succeeded").get<bool>();
    for (const Json& fault : record.at("schedule")) {
      const std::string kind = fault.at("kind");
      ++flights[kind];
      broken[kind] += breaks;
    }
  }
  std::string text = fmt::format("{:16} {:>6} {:>7}\n", "fault", "drawn", "broken");
  for (const FaultKindInfo& info : fault_kinds()) {
    text += fmt::format("{:16} {:>6} {:>7}\n", info.name, flights[info.name], broken[info.name]);
  }
  return text + fmt::format("{} flights, {} went as without a fault, {} broke an invariant\n",
                            records.size(), succeeded, bad);
}

/// What must be the same for an interrupted search to go on.
std::string manifest(const FaultsOptions& options, const CommonOptions& common) {
  const Json all = {{"scenario", core::read_file(options.scenario)},
                    {"seconds", options.most_s},
                    {"configuration", configuration_text(read_configuration(common))}};
  return all.dump(1) + "\n";
}

int search(const FaultsOptions& options, const CommonOptions& common) {
  const FaultFlight flight = flight_of(options, common);
  const std::string wanted = manifest(options, common);
  CommonOptions outer = common;
  outer.force = common.force || goes_on(common, "faults.json", wanted);
  const OutputFolder out(outer);
  core::write_file(out / "faults.json", wanted);
  std::vector<std::future<Json>> flights;
  core::TaskThreads side_by_side(common.threads);
  for (int i = 0; i < options.runs; ++i) {
    auto task = std::make_shared<std::packaged_task<Json()>>(
        [&out, &options, one = drawn(flight, common.seed + static_cast<std::uint64_t>(i))] {
          return flown(one, out.path(), options.tries);
        });
    flights.push_back(task->get_future());
    side_by_side.push([task] { (*task)(); });
  }
  core::Progress progress("flights with faults", options.runs);
  std::vector<Json> records;
  for (std::future<Json>& each : flights) {
    records.push_back(each.get());
    say(records.back());
    progress.update(static_cast<long>(records.size()));
  }
  const std::string table = table_of(records);
  core::write_file(out / "table.txt", table);
  std::cout << table;
  return std::ranges::all_of(records, [](const Json& r) { return r.at("breaches").empty(); }) ? 0
                                                                                              : 1;
}

/// What is recorded, flown again: the same path to the byte.
int replay(const FaultsOptions& options, const CommonOptions& common) {
  const Json record = read_record(options.replay);
  FaultFlight flight = flight_of(options, common);
  try {
    flight.seed = record.at("seed");
    flight.most_s = record.at("most_s");
    flight.schedule = faults_from_json(record.at("schedule"), options.replay);
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{}: no record of a flight: {}", options.replay, error.what()));
  }
  flight.files = fs::temp_directory_path() / fmt::format("saker_faults_{}", ::getpid());
  const FaultOutcome outcome = fly_with_faults(flight);
  std::cout << outcome.record.dump(1) << "\n";
  const bool same = outcome.digest == record.at("digest").get<std::string>();
  if (!same) spdlog::error("{}: another path than recorded", options.replay);
  return same && outcome.breaches.empty() ? 0 : 1;
}

}  // namespace

void add_faults(Commands& commands) {
  auto options = std::make_shared<FaultsOptions>();
  CLI::App& app = commands.add(
      {.name = "faults",
       .does = "missions in lockstep with random faults, and what must hold in each; goes on where "
               "it was interrupted",
       .output = Output::optional_folder,
       .example = "saker faults configs/scenarios/small.yaml -o out --runs 100"},
      [options](const CommonOptions& common) {
        if (!options->replay.empty()) return replay(*options, common);
        if (common.out.empty()) throw Error("-o OUT is missing: expected a folder for the records");
        return search(*options, common);
      });
  app.add_option("SCENARIO", options->scenario, "what to fly in (*.yaml, kind mission)")
      ->required();
  app.add_option("--runs", options->runs, "flights: seed --seed and those that follow")
      ->check(CLI::Range(1, 1000000));
  app.add_option("--seconds", options->most_s, "of a mission that are looked at")
      ->check(CLI::Range(10.0, 3600.0));
  app.add_option("--tries", options->tries, "flights that look for the fewest faults of a breach")
      ->check(CLI::Range(0, 1000));
  app.add_option("--replay", options->replay,
                 "flies OUT/NNNNNN.json again: its breaches, and whether the path is the same");
}

}  // namespace saker::tools
