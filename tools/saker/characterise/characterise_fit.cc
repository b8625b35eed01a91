#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <set>

#include "saker/core/error.h"
#include "saker/uncertainty/evaluation.h"
#include "saker/uncertainty/fit.h"
#include "saker/uncertainty/regions.h"
#include "tools/saker/characterise/characterise.h"
#include "tools/saker/command.h"
#include "tools/saker/configuration.h"
#include "tools/saker/picture/model_pictures.h"

namespace saker::tools {
namespace {

using uncertainty::Sample;

struct FitOptions {
  std::vector<std::string> samples, test;
  std::string add_to;
  std::string pictures;
  uncertainty::Provenance provenance;
};

std::vector<Sample> read_all(const std::vector<std::string>& files,
                             const objects::ClassTable& table) {
  std::vector<Sample> all;
  for (const std::string& file : files) {
    const std::vector<Sample> own = uncertainty::read_samples(file, table);
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

/// Recordings that are fitted may not be tested on.
void check_disjoint(const std::vector<Sample>& fitted, const std::vector<Sample>& tested) {
  std::set<std::string> recordings;
  for (const Sample& sample : fitted) recordings.insert(sample.recording);
  for (const Sample& sample : tested) {
    if (recordings.contains(sample.recording)) {
      throw Error(fmt::format("recording {} is both fitted and tested: expected disjoint ones",
                              sample.recording));
    }
  }
}

void print_fit(const uncertainty::ClassModel& model, const std::string& name) {
  std::cout << fmt::format("{}: {} objects in {} recordings, {} samples\n", name, model.objects,
                           model.recordings, model.samples);
  for (const uncertainty::Trial& trial : model.trials) {
    std::cout << fmt::format("  {:28} gain {:9.2g} +- {:.2g}: {}\n", trial.what, trial.gain,
                             trial.standard_error, trial.kept ? "kept" : "left out");
  }
  const Eigen::VectorXd sd = model.geometric.parts().common.diagonal().cwiseSqrt();
  std::cout << "  shared by all views of an object, sd:";
  for (const double value : sd) std::cout << fmt::format(" {:.3f}", value);
  std::cout << " m\n";
}

void print_regions(const uncertainty::Model& model, objects::ClassId id) {
  const uncertainty::Regions regions({}, model, id);
  std::cout << fmt::format(
      "  regions: confidence >= {:.3f}{}, probability of small errors >= {:.3f}{}\n",
      regions.least_confidence(), regions.relative_confidence() ? " (the best share)" : "",
      regions.least_probability(), regions.relative_probability() ? " (the best share)" : "");
}

void print_test(const uncertainty::Evaluation& test) {
  std::cout << fmt::format(
      "  held out: NEES {:.2f} of {} objects and cells, {:.2f} of {} objects with all their "
      "cells\n",
      test.nees, test.draws, test.fused_nees, test.objects);
  std::cout << "  held out: error with all cells, mean +- sd:";
  for (Eigen::Index i = 0; i < test.fused_error_mean.size(); ++i) {
    std::cout << fmt::format(" {:.3f} +- {:.3f}", test.fused_error_mean[i], test.fused_error_sd[i]);
  }
  std::cout << fmt::format(" m\n  held out: confidence off by {:.4f}, by a constant {:.4f}\n",
                           test.confidence_error, test.constant_error);
}

std::string joined(const std::string& older, const std::string& newer) {
  if (older.empty() || older == newer) return newer;
  return newer.empty() ? older : older + "; " + newer;
}

/// What was fitted, and of the older model the classes that it lacks.
uncertainty::Model added(const uncertainty::Model& older,
                         std::vector<uncertainty::ClassModel> fitted,
                         const uncertainty::Provenance& newer) {
  std::set<objects::ClassId> known;
  for (const uncertainty::ClassModel& model : fitted) known.insert(model.id);
  for (const auto& [id, model] : older.classes()) {
    if (!known.contains(id)) fitted.push_back(model);
  }
  const uncertainty::Provenance& from = older.provenance();
  return uncertainty::Model(fitted,
                            {joined(from.data, newer.data), joined(from.sensor, newer.sensor),
                             joined(from.commit, newer.commit), newer.seed});
}

int fit(const FitOptions& options, const CommonOptions& common) {
  const flight::ProcessConfig config = read_configuration(common);
  const objects::ClassTable& table = config.autonomy.objects;
  const std::filesystem::path file = output_file(common.out, common.force);
  const std::vector<Sample> samples = read_all(options.samples, table);
  const std::vector<Sample> unseen = read_all(options.test, table);
  check_disjoint(samples, unseen);
  uncertainty::Provenance provenance = options.provenance;
  provenance.seed = common.seed;
  const auto older = options.add_to.empty() ? uncertainty::Model()
                                            : uncertainty::Model::load(options.add_to, table);
  const auto fitted = uncertainty::fit(samples, table, config.fit, common.seed);
  const uncertainty::Model model = added(older, fitted, provenance);
  for (const uncertainty::ClassModel& own : fitted) {
    print_fit(own, table[own.id].name);
    print_regions(model, own.id);
    if (unseen.empty()) continue;
    print_test(uncertainty::evaluate(model, own.id, unseen));
  }
  model.save(file, table);
  if (options.pictures.empty()) return 0;
  std::filesystem::create_directories(options.pictures);
  write_model_pictures(options.pictures, model, table);
  return 0;
}

}  // namespace

void add_characterise_fit(Commands& commands, CLI::App& group) {
  auto options = std::make_shared<FitOptions>();
  CLI::App& app = commands.add(
      group,
      {.name = "fit",
       .does = "samples into the models of confidence, bias and covariance",
       .output = Output::file,
       .example = "saker characterise fit train/samples.csv --test test/samples.csv -o "
                  "uncertainty.yaml"},
      [options](const CommonOptions& common) { return fit(*options, common); });
  app.add_option("SAMPLES", options->samples, "measurements beside the truth (CSV)")->required();
  app.add_option("--test", options->test, "samples of other recordings, to judge the models by")
      ->type_name("SAMPLES");
  app.add_option("--add-to", options->add_to,
                 "an older model file, whose other classes are taken over")
      ->type_name("FILE");
  app.add_option("--pictures", options->pictures, "folder for pictures of the models")
      ->type_name("DIR");
  app.add_option("--data", options->provenance.data, "what was flown, for the model file")
      ->type_name("TEXT");
  app.add_option("--sensor", options->provenance.sensor, "and with which sensor")
      ->type_name("TEXT");
  app.add_option("--commit", options->provenance.commit, "and by which commit of the program")
      ->type_name("TEXT");
}

}  // namespace saker::tools
