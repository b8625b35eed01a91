#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

#include "saker/core/error.h"
#include "saker/core/statistics.h"
#include "saker/uncertainty/fit.h"
#include "saker/uncertainty/held_out.h"

namespace saker::uncertainty {
namespace {

using Parts = GeometricModel::Parts;

/// A draw and from where it was measured, as if from the left.
struct SeenDraw {
  Draw draw;
  View view;
  std::string recording;
};

/// Mean of the values that are known.
class KnownMean {
 public:
  void add(double value) {
    if (!std::isfinite(value)) return;
    sum_ += value;
    ++count_;
  }
  [[nodiscard]] double mean() const { return count_ > 0 ? sum_ / count_ : NAN; }

 private:
  double sum_ = 0;
  int count_ = 0;
};

View mean_view(const std::vector<const Sample*>& samples) {
  KnownMean range, angle, elevation, reflectivity;
  for (const Sample* sample : samples) {
    range.add(sample->view.range);
    angle.add(std::abs(sample->view.angle));
    elevation.add(sample->view.elevation);
    reflectivity.add(sample->view.reflectivity);
  }
  return {range.mean(), angle.mean(), elevation.mean(), reflectivity.mean()};
}

Eigen::VectorXd mean_error(const std::vector<const Sample*>& samples) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(samples.front()->error.size());
  for (const Sample* sample : samples) sum += sample->error;
  return sum / static_cast<double>(samples.size());
}

/// One draw for each object and cell, in the order of recordings, objects and cells; whole ones.
std::vector<SeenDraw> draws_of(std::span<const Sample> samples, const Intervals& intervals,
                               const FitConfig& config) {
  std::map<std::tuple<std::string, int, int>, std::vector<const Sample*>> grouped;
  for (const Sample& sample : samples) {
    if (!intervals.contains(sample.view.range) || !is_whole(sample, config.most_length_sd_m()))
      continue;
    grouped[{sample.recording, sample.object_id, intervals.cell_of(sample.view)}].push_back(
        &sample);
  }
  const Eigen::VectorXd parity = mirror(samples.front().error.size(), intervals.sectors);
  std::vector<SeenDraw> draws;
  std::pair<std::string, int> last;
  int object = -1;
  for (const auto& [key, own] : grouped) {
    const std::pair<std::string, int> current = {std::get<0>(key), std::get<1>(key)};
    if (object < 0 || current != last) ++object;
    last = current;
    const View& first = own.front()->view;
    Draw draw;
    draw.error = mean_error(own);
    draw.object = object;
    draw.interval = intervals.of(first);
    draw.mirrored = intervals.mirrored(first);
    if (draw.mirrored) draw.error = draw.error.cwiseProduct(parity);
    draws.push_back({std::move(draw), mean_view(own), current.first});
  }
  return draws;
}

/// Objects numbered from 0 without gaps.
std::vector<Draw> renumbered(std::span<const SeenDraw> seen) {
  std::map<int, int> numbers;
  std::vector<Draw> draws;
  for (const SeenDraw& s : seen) {
    draws.push_back(s.draw);
    draws.back().object =
        numbers.emplace(s.draw.object, static_cast<int>(numbers.size())).first->second;
  }
  return draws;
}

/// Mean of a covariate in each interval; of all, where an interval has none.
std::vector<double> means_of(Covariate covariate, std::span<const SeenDraw> draws, int intervals) {
  std::vector<KnownMean> sums(static_cast<std::size_t>(intervals));
  KnownMean all;
  for (const SeenDraw& seen : draws) {
    const double value = value_of(seen.view, covariate);
    sums[static_cast<std::size_t>(seen.draw.interval)].add(value);
    all.add(value);
  }
  std::vector<double> means;
  for (const KnownMean& sum : sums) {
    means.push_back(std::isfinite(sum.mean()) ? sum.mean() : all.mean());
  }
  return means;
}

/// Its deviations from the intervals' means in standard deviations, one a draw; empty where it does
/// not vary.
struct Deviations {
  std::vector<double> means;
  double spread = NAN;
  std::vector<double> z;
};

Deviations deviations_of(Covariate covariate, std::span<const SeenDraw> draws, int intervals) {
  Deviations deviations;
  deviations.means = means_of(covariate, draws, intervals);
  std::vector<double> known;
  for (const SeenDraw& seen : draws) {
    const double value = value_of(seen.view, covariate);
    const double mean = deviations.means[static_cast<std::size_t>(seen.draw.interval)];
    if (std::isfinite(value)) known.push_back(value - mean);
  }
  deviations.spread = core::standard_deviation(known);
  for (const SeenDraw& seen : draws) {
    const double mean = deviations.means[static_cast<std::size_t>(seen.draw.interval)];
    deviations.z.push_back(standardised(value_of(seen.view, covariate), mean, deviations.spread));
  }
  return deviations;
}

/// Least squares of what the intervals' biases leave over, entry by entry; 0 about the truth.
Eigen::VectorXd bias_slope(std::span<const SeenDraw> seen, std::span<const Draw> draws,
                           const RandomEffects& effects, const std::vector<double>& z,
                           const Eigen::VectorXd& parity, bool about_truth) {
  Eigen::VectorXd products = Eigen::VectorXd::Zero(parity.size());
  if (about_truth) return products;
  Eigen::VectorXd squares = products;
  for (std::size_t i = 0; i < draws.size(); ++i) {
    const Eigen::VectorXd rest =
        draws[i].error - effects.bias[static_cast<std::size_t>(draws[i].interval)];
    const Eigen::VectorXd reach = z[i] * reach_of_slope(parity, seen[i].view.angle);
    products += rest.cwiseProduct(reach);
    squares += reach.cwiseAbs2();
  }
  return products.cwiseQuotient(squares.cwiseMax(1.0));
}

/// The most likely slope of the covariance's logarithm, by Newton's method.
double log_scale_slope(std::span<const Draw> draws, const RandomEffects& effects,
                       const std::vector<double>& z, double most_sd) {
  constexpr double kMost = 0.5;  // a standard deviation: scales of e^±1.25 within what was flown
  constexpr int kIterations = 20;
  const auto n = static_cast<double>(effects.common.rows());
  std::vector<double> ratios;  // squared errors over what was expected
  for (std::size_t i = 0; i < draws.size(); ++i) {
    const auto interval = static_cast<std::size_t>(draws[i].interval);
    const Eigen::VectorXd rest = draws[i].error - effects.bias[interval];
    const Eigen::MatrixXd covariance = effects.covariance[interval] + effects.common;
    const double squared = rest.dot(covariance.llt().solve(rest));
    ratios.push_back(std::min(squared, most_sd * most_sd) / n);
  }
  double slope = 0;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    double gradient = 0, curvature = 1;
    for (std::size_t i = 0; i < ratios.size(); ++i) {
      const double scaled = ratios[i] * std::exp(-slope * z[i]);
      gradient += z[i] * (scaled - 1);
      curvature += z[i] * z[i] * scaled;
    }
    slope = std::clamp(slope + gradient / curvature, -kMost, kMost);
  }
  return slope;
}

int distance(const Intervals& intervals, int a, int b) {
  return std::abs(a / intervals.sectors - b / intervals.sectors) +
         std::abs(a % intervals.sectors - b % intervals.sectors);
}

/// Intervals that were hardly flown take the values of the nearest that was, if there is one, as
/// they look from there.
void fill(Parts& parts, const RandomEffects& effects, std::span<const Eigen::VectorXd> alike,
          int least_draws) {
  const int count = parts.intervals.size();
  for (int i = 0; i < count; ++i) {
    int nearest = -1;
    for (int other = 0; other < count; ++other) {
      if (effects.draws[static_cast<std::size_t>(other)] < least_draws) continue;
      if (nearest < 0 ||
          distance(parts.intervals, i, other) < distance(parts.intervals, i, nearest)) {
        nearest = other;
      }
    }
    const auto from = static_cast<std::size_t>(nearest < 0 ? i : nearest);
    auto& interval = parts.fitted[static_cast<std::size_t>(i)];
    const Eigen::VectorXd turned = alike[static_cast<std::size_t>(i)].cwiseProduct(alike[from]);
    interval.bias = turned.cwiseProduct(effects.bias[from]);
    interval.covariance = turned.asDiagonal() * effects.covariance[from] * turned.asDiagonal();
    interval.objects = nearest == i ? effects.draws[from] : 0;
  }
}

/// Errors of vehicles are alike by their nearer end: seen from behind, x points away from it.
std::vector<Eigen::VectorXd> alike_by_nearer_end(const Intervals& intervals,
                                                 Eigen::Index dimension) {
  std::vector<Eigen::VectorXd> alike(static_cast<std::size_t>(intervals.size()),
                                     Eigen::VectorXd::Ones(dimension));
  if (intervals.sectors < 2) return alike;
  for (int i = 0; i < intervals.size(); ++i) {
    const double angle = intervals.sector_centre(i % intervals.sectors);
    if (angle > std::numbers::pi / 2) alike[static_cast<std::size_t>(i)][0] = -1;
  }
  return alike;
}

Parts fit_parts(std::span<const SeenDraw> seen, const Intervals& intervals,
                const std::vector<Covariate>& covariates, const FitConfig& config) {
  std::vector<Draw> draws = renumbered(seen);
  const Eigen::VectorXd parity = mirror(draws.front().error.size(), intervals.sectors);
  const auto alike = alike_by_nearer_end(intervals, parity.size());
  RandomEffects effects = random_effects(draws, alike, parity, config.errors);
  Parts parts;
  parts.intervals = intervals;
  parts.fitted.resize(static_cast<std::size_t>(intervals.size()));
  for (auto& interval : parts.fitted) {
    interval.covariate_mean.resize(static_cast<Eigen::Index>(covariates.size()));
  }
  for (std::size_t k = 0; k < covariates.size(); ++k) {
    const Deviations by = deviations_of(covariates[k], seen, intervals.size());
    const Eigen::VectorXd bias =
        bias_slope(seen, draws, effects, by.z, parity, config.errors.about_truth);
    for (std::size_t i = 0; i < draws.size(); ++i) {
      draws[i].error -= by.z[i] * bias.cwiseProduct(reach_of_slope(parity, seen[i].view.angle));
    }
    effects = random_effects(draws, alike, parity, config.errors);
    parts.slopes.push_back({covariates[k], by.spread, bias,
                            log_scale_slope(draws, effects, by.z, config.errors.most_sd)});
    for (std::size_t i = 0; i < parts.fitted.size(); ++i) {
      parts.fitted[i].covariate_mean[static_cast<Eigen::Index>(k)] = by.means[i];
    }
  }
  parts.common = effects.common;
  fill(parts, effects, alike, config.least_draws);
  return parts;
}

/// Of an object's measurements from each interval those that are whole, the mean over objects; the
/// class's mean share counts as it does in biases.
void share_out(Parts& parts, std::span<const Sample> samples, const RandomEffectsConfig& config) {
  struct Count {
    double whole = 0, all = 0;
    [[nodiscard]] double share() const { return all > 0 ? whole / all : 1; }
  };
  std::map<std::tuple<int, std::string, int>, Count> of_object;
  for (const Sample& sample : samples) {
    if (!parts.intervals.contains(sample.view.range)) continue;
    Count& count = of_object[{parts.intervals.of(sample.view), sample.recording, sample.object_id}];
    count.all += 1;
    count.whole += is_whole(sample, parts.whole_length_sd_m) ? 1 : 0;
  }
  std::vector<Count> of_interval(parts.fitted.size());
  Count of_class;
  for (const auto& [key, count] : of_object) {
    for (Count* sum : {&of_interval[static_cast<std::size_t>(std::get<0>(key))], &of_class}) {
      sum->whole += count.share();
      sum->all += 1;
    }
  }
  for (std::size_t i = 0; i < parts.fitted.size(); ++i) {
    of_interval[i].whole += config.bias_prior_draws * of_class.share();
    of_interval[i].all += config.bias_prior_draws;
    parts.fitted[i].whole = of_interval[i].share();
  }
}

double log_likelihood(const SeenDraw& seen, const GeometricModel& model) {
  const GeometricModel::Expected expected = model.expected(seen.view);
  const Eigen::LLT<Eigen::MatrixXd> factor(expected.covariance + model.parts().common);
  const Eigen::VectorXd rest = seen.draw.error - expected.bias;
  const double half_log_det = factor.matrixLLT().diagonal().array().log().sum();
  const auto n = static_cast<double>(rest.size());
  return -0.5 * (n * std::log(2 * std::numbers::pi) + rest.dot(factor.solve(rest))) - half_log_det;
}

/// The mean log-likelihood of each recording's draws, from fits without it.
HeldOut scores(const std::vector<SeenDraw>& draws, const Intervals& intervals,
               const std::vector<Covariate>& covariates, const FitConfig& config) {
  std::vector<std::string> recordings;
  for (const SeenDraw& draw : draws) recordings.push_back(draw.recording);
  return held_out(recordings, config.folds, [&](const auto& is_held_out) {
    std::vector<SeenDraw> seen, unseen;
    for (const SeenDraw& draw : draws) {
      (is_held_out(draw.recording) ? unseen : seen).push_back(draw);
    }
    if (seen.empty()) return HeldOut{};
    const GeometricModel model(fit_parts(seen, intervals, covariates, config));
    std::map<std::string, std::vector<double>> likelihoods;
    for (const SeenDraw& draw : unseen) {
      likelihoods[draw.recording].push_back(log_likelihood(draw, model));
    }
    HeldOut means;
    for (const auto& [recording, values] : likelihoods) means[recording] = core::mean(values);
    return means;
  });
}

}  // namespace

GeometricModel fit_geometric(std::span<const Sample> samples, const Intervals& intervals,
                             const FitConfig& config, std::vector<Trial>& trials) {
  const std::vector<SeenDraw> draws = draws_of(samples, intervals, config);
  if (draws.empty()) {
    throw Error(
        fmt::format("samples: none that is whole from {} ... {} m, the intervals of the fit",
                    intervals.range_edges.front(), intervals.range_edges.back()));
  }
  std::vector<Covariate> kept;
  HeldOut best = scores(draws, intervals, kept, config);
  for (const Covariate covariate : {Covariate::elevation, Covariate::reflectivity}) {
    if (!(deviations_of(covariate, draws, intervals.size()).spread > 0)) continue;
    std::vector<Covariate> more = kept;
    more.push_back(covariate);
    const HeldOut with = scores(draws, intervals, more, config);
    const std::string name = enum_names(covariate)[static_cast<std::size_t>(covariate)];
    trials.push_back(trial("errors: " + name, with, best, config.standard_errors));
    if (!trials.back().kept) continue;
    kept = more;
    best = with;
  }
  Parts parts = fit_parts(draws, intervals, kept, config);
  parts.whole_length_sd_m = config.most_length_sd_m();
  share_out(parts, samples, config.errors);
  return GeometricModel(std::move(parts));
}

}  // namespace saker::uncertainty
