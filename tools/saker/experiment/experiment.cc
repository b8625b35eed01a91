#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <future>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <set>

#include "saker/core/config_io.h"
#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/core/parallel.h"
#include "saker/core/progress.h"
#include "saker/simulation/mission/mission_world.h"
#include "tools/saker/command.h"
#include "tools/saker/configuration.h"
#include "tools/saker/experiment/experiment_report.h"
#include "tools/saker/experiment/mission_run.h"
#include "tools/saker/experiment/variant.h"
#include "tools/saker/mission/team_mission.h"
#include "tools/saker/record/run_recording.h"
#include "tools/saker/report/html_report.h"

namespace saker::tools {
namespace {

namespace fs = std::filesystem;

constexpr const char* kResults = "results.json";

struct ExperimentOptions {
  std::vector<std::string> scenarios;
  std::vector<std::string> policies, variants;  ///< neither: the configuration's policy
  int runs = 1;
  std::string record;  ///< an MCAP file; empty: none
};

/// A run, and the folder inside OUT that it has for itself.
struct Job {
  MissionRun run;
  fs::path folder;
};

/// Policies first, then what was given with --variant.
std::vector<Variant> variants_of(const ExperimentOptions& options, const CommonOptions& common) {
  std::vector<Variant> variants;
  for (const std::string& policy : options.policies) variants.push_back(policy_variant(policy));
  for (const std::string& text : options.variants) variants.push_back(variant_of(text));
  if (variants.empty()) {
    const auto policy = read_configuration(common).autonomy.active.policy;
    variants = {policy_variant(active::enum_names(policy)[static_cast<std::size_t>(policy)])};
  }
  std::set<std::string> names;
  for (const Variant& variant : variants) {
    if (!names.insert(variant.name).second) throw Error(variant.name + ": named twice");
  }
  return variants;
}

/// OUT[/SCENARIO][/VARIANT][/seed-N]: what there are several of has folders.
fs::path folder_of(const ExperimentOptions& options, const MissionRun& run, bool several_variants) {
  fs::path folder;
  if (options.scenarios.size() > 1) folder /= run.scenario;
  if (several_variants) folder /= run.policy;
  if (options.runs > 1) folder /= fmt::format("seed-{}", run.seed);
  return folder;
}

/// The same worlds, which follow from scenario and seed, for each variant.
std::vector<Job> jobs_of(const ExperimentOptions& options, const std::vector<Variant>& variants,
                         const CommonOptions& common) {
  const autonomy::Config config = read_configuration(common).autonomy;
  std::vector<Job> jobs;
  for (const std::string& scenario : options.scenarios) {
    const simulation::MissionConfig site = read_site(scenario);
    for (const Variant& variant : variants) {
      autonomy::Config chosen = config;
      for (const std::string& setting : variant.settings) {
        chosen = core::config_with_setting(setting, std::move(chosen));
      }
      for (int i = 0; i < options.runs; ++i) {
        const std::uint64_t seed = common.seed + static_cast<std::uint64_t>(i);
        MissionRun run{.scenario = fs::path(scenario).stem(),
                       .policy = variant.name,
                       .site = site,
                       .config = chosen,
                       .seed = seed,
                       .threads = common.threads,
                       .log = spdlog::default_logger()};
        fs::path folder = folder_of(options, run, variants.size() > 1);
        jobs.push_back({std::move(run), std::move(folder)});
      }
    }
  }
  return jobs;
}

/// A site without room is an error before anything is flown; where it was flown there was room.
void check_sites(const std::vector<Job>& jobs, const CommonOptions& common) {
  std::set<std::pair<std::string, std::uint64_t>> checked;
  for (const Job& job : jobs) {
    if (!common.force && fs::exists(fs::path(common.out) / job.folder / kResults)) continue;
    if (!checked.emplace(job.run.scenario, job.run.seed).second) continue;
    try {
      (void)simulation::build_mission_world(job.run.site, job.run.seed);
    } catch (const Error& error) {
      throw Error(fmt::format("{}, seed {}: {}", job.run.scenario, job.run.seed, error.what()));
    }
  }
}

/// What must be the same for an interrupted experiment to go on.
std::string manifest(const ExperimentOptions& options, const std::vector<Variant>& variants,
                     const CommonOptions& common) {
  Json scenarios = Json::array(), named = Json::array();
  for (const Variant& v : variants) named.push_back({{"name", v.name}, {"settings", v.settings}});
  for (const std::string& file : options.scenarios) {
    scenarios.push_back({{"file", file}, {"content", core::read_file(file)}});
  }
  const Json all = {{"scenarios", scenarios},
                    {"variants", named},
                    {"several_runs", options.runs > 1},
                    {"seed", common.seed},
                    {"configuration", configuration_text(read_configuration(common))}};
  return all.dump(1) + "\n";
}

/// One of several: on one thread, with a log of its own.
Json run_or_read(Job job, const fs::path& out) {
  const fs::path folder = out / job.folder;
  if (auto results = finished(folder)) return *results;
  spdlog::info("{} with {}, seed {}", job.run.scenario, job.run.policy, job.run.seed);
  job.run.threads = 1;
  job.run.log = log_of_run(folder);
  job.run.shows_progress = false;
  return fly(job.run, folder);
}

/// Seed by seed: what an interrupted experiment leaves compares all scenarios and policies.
std::vector<std::size_t> by_seed(const std::vector<Job>& jobs) {
  std::vector<std::size_t> order(jobs.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return jobs[i].run.seed; });
  return order;
}

/// Missions side by side on all threads; results in the order of the jobs.
std::vector<Json> fly_all(const std::vector<Job>& jobs, int threads, const fs::path& out) {
  if (jobs.size() == 1) {
    if (auto results = finished(out / jobs[0].folder)) return {*results};
    return {fly(jobs[0].run, out)};
  }
  const std::vector<std::size_t> order = by_seed(jobs);
  std::vector<std::future<Json>> flights(jobs.size());
  core::TaskThreads side_by_side(threads);
  for (const std::size_t i : order) {
    auto task = std::make_shared<std::packaged_task<Json()>>(
        [&job = jobs[i], &out] { return run_or_read(job, out); });
    flights[i] = task->get_future();
    side_by_side.push([task] { (*task)(); });
  }
  core::Progress progress("missions", static_cast<long>(jobs.size()));
  std::vector<Json> results(jobs.size());
  long done = 0;
  for (const std::size_t i : order) {
    results[i] = flights[i].get();
    progress.update(++done);
  }
  return results;
}

/// Whether the mission went as it should; says what did not.
bool good(const Json& run) {
  const bool found = run.at("found") == run.at("targets");
  if (run.at("succeeded") && run.at("collisions") == 0 && found) return true;
  spdlog::warn("{}, seed {}: {} at {}, {} of {} targets found, {} collisions",
               run["scenario"].get<std::string>(), run["seed"].get<int>(),
               run["outcome"].get<std::string>(), run["phase"].get<std::string>(),
               run["found"].get<int>(), run["targets"].get<int>(), run["collisions"].get<int>());
  return false;
}

/// The one run goes into the file of --record, too.
void record(const ExperimentOptions& options, const CommonOptions& common, std::vector<Job>& jobs) {
  const auto file = record_file(options.record, common.force);
  if (!file) return;
  if (jobs.size() != 1)
    throw Error(fmt::format("--record: {} runs, expected one: saker convert makes a file of each",
                            jobs.size()));
  if (!common.force && fs::exists(fs::path(common.out) / kResults))
    throw Error("--record: " + common.out + " is finished and not flown again, expected --force");
  jobs.front().run.record = file;
  jobs.front().run.origin = read_configuration(common).site.origin;
}

/// A page of each run, and one of all.
void leave_reports(const std::vector<Job>& jobs, const fs::path& out, const CommonOptions& common) {
  flight::ProcessConfig config = read_configuration(common);
  const auto title = [](const MissionRun& run) {
    return fmt::format("Mission {}, {}, seed {}", run.scenario, run.policy, run.seed);
  };
  if (jobs.size() > 1) {
    for (const Job& job : jobs) {
      flight::ProcessConfig own = config;
      own.autonomy = job.run.config;
      write_html_report(out / job.folder, title(job.run), own);
    }
    leave_html_report(out, fmt::format("{} missions", jobs.size()), config);
    return;
  }
  config.autonomy = jobs.front().run.config;
  leave_html_report(out, title(jobs.front().run), config);
}

int experiment(const ExperimentOptions& options, const CommonOptions& common) {
  const std::vector<Variant> variants = variants_of(options, common);
  std::vector<Job> jobs = jobs_of(options, variants, common);
  record(options, common, jobs);
  check_sites(jobs, common);
  const std::string wanted = manifest(options, variants, common);
  CommonOptions outer = common;
  outer.force = common.force || goes_on(common, "experiment.json", wanted);
  const OutputFolder out(outer);
  if (common.force) {
    for (const Job& job : jobs) fs::remove(out.path() / job.folder / kResults);
  }
  core::write_file(out / "experiment.json", wanted);

  const std::vector<Json> results = fly_all(jobs, common.threads, out.path());
  bool all_good = true;
  for (const Json& run : results) all_good = good(run) && all_good;
  std::vector<FlownRun> runs;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    runs.push_back({out.path() / jobs[i].folder, results[i]});
  }
  std::cout << write_report(runs, out.path()) << std::flush;
  leave_reports(jobs, out.path(), common);
  return all_good ? 0 : 1;
}

}  // namespace

void add_experiment(Commands& commands) {
  auto options = std::make_shared<ExperimentOptions>();
  CLI::App& app = commands.add(
      {.name = "experiment",
       .does = "whole missions, world and vehicle simulated, in lockstep; goes on where it was "
               "interrupted",
       .output = Output::folder,
       .example = "saker experiment configs/scenarios/demo.yaml -o out --runs 10"},
      [options](const CommonOptions& common) { return experiment(*options, common); });
  app.add_option("SCENARIO", options->scenarios, "what to fly in (*.yaml, kind mission)")
      ->required();
  app.add_option("--policy", options->policies,
                 "policies, separated by commas; active.policy when not given")
      ->delimiter(',')
      ->check(CLI::IsMember(active::enum_names(active::PolicyName::visit)));
  app.add_option(
         "--variant", options->variants,
         "\"NAME KEY=VALUE …\": a configuration to compare, by a name of its own; repeatable")
      ->type_name("TEXT")
      ->allow_extra_args(false);
  app.add_option("--record", options->record,
                 "write the one run with its scans into an MCAP file for viewers and saker replay")
      ->type_name("FILE");
  app.add_option("--runs", options->runs, "seeds of each: --seed and those that follow")
      ->check(CLI::Range(1, 100000));
}

}  // namespace saker::tools
