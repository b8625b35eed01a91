#include "saker/detection/face_density.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace saker::detection {
namespace {

constexpr double kFarthest = 6.0;  // m, beyond the hits, of an end
constexpr double kWidest = 2.6;    // m, beyond the hits, of a side: one face of it was seen
constexpr double kWithin = 0.4;    // m, inside of the middle strip

double log_normal_cdf(double x) {
  if (x > -6) return std::log(0.5 * std::erfc(-x / std::sqrt(2.0)));
  return -0.5 * x * x - std::log(-x * std::sqrt(2 * M_PI));  // its tail
}

/// Log-density of exponential setback plus Gaussian noise at `behind` the face (exponentially
/// modified Gaussian).
double log_setback(double behind, double mean, double sd) {
  return -std::log(mean) + 0.5 * sd * sd / (mean * mean) - behind / mean +
         log_normal_cdf(behind / sd - sd / mean);
}

struct StripRange {
  double low = INFINITY, high = -INFINITY;
};

struct LayerSum {
  double low = 0, high = 0;
  int lows = 0, highs = 0, all = 0;
};

/// How far places reach along an axis, by strips across it.
struct Strips {
  double width;
  int first = 0;
  std::vector<int> strip_of;  ///< of each place, from `first`
  std::vector<StripRange> ranges;

  Strips(const Places& places, int axis, double strip_m) : width(strip_m) {
    strip_of.reserve(places.size());
    for (const Eigen::Vector2d& p : places) {
      strip_of.push_back(static_cast<int>(std::floor(p[1 - axis] / width)));
    }
    const auto [low, high] = std::ranges::minmax(strip_of);
    first = low;
    ranges.resize(static_cast<std::size_t>(high - low + 1));
    for (std::size_t i = 0; i < places.size(); ++i) {
      StripRange& range = ranges[strip_of[i] -= first];
      range.low = std::min(range.low, places[i][axis]);
      range.high = std::max(range.high, places[i][axis]);
    }
  }

  [[nodiscard]] double across(std::size_t i) const {
    return (first + static_cast<int>(i) + 0.5) * width;
  }
};

/// Where four of five lie within.
double most_of(std::vector<double>& outward) {
  const auto at = outward.begin() + static_cast<std::ptrdiff_t>(outward.size() * 4 / 5);
  const auto it = at == outward.end() ? at - 1 : at;
  std::ranges::nth_element(outward, it);
  return *it;
}

void set_reach(const Strips& strips, FaceStrips& faces) {
  std::vector<double> low, high;
  for (const StripRange& range : strips.ranges) {
    if (range.low > range.high) continue;
    low.push_back(-range.low);
    high.push_back(range.high);
  }
  faces.low_reach = -most_of(low);
  faces.high_reach = most_of(high);
}

/// Mean of the most of them that are together: the flat part of a face, not what stands before a
/// part of it.
double together(std::vector<double> outward) {
  constexpr double kTogether = 0.1;  // m
  std::ranges::sort(outward);
  auto first = outward.begin(), from = first, to = first;
  for (auto last = outward.begin(); last != outward.end(); ++last) {
    while (*last - *first > kTogether) ++first;
    if (last + 1 - first >= to - from) from = first, to = last + 1;
  }
  return std::accumulate(from, to, 0.0) / static_cast<double>(to - from);
}

/// What one strip tells, but for the face's bow.
struct Panel {
  double outward = 0;
  double back = 0;  ///< of the bow's depth, by which the face stands back there
};

/// One alone may be a mirror.
template <class Outward>
double second_outermost(const std::vector<Outward>& all) {
  std::array<double, 2> most = {-INFINITY, -INFINITY};
  for (const Outward& one : all) {
    most[1] = std::max(most[1], std::min(most[0], one.outward));
    most[0] = std::max(most[0], one.outward);
  }
  return std::isfinite(most[1]) ? most[1] : most[0];
}

/// Half of them reach farther: leaves before half of a face do.
double middle_place(std::vector<Panel> panels) {
  if (panels.empty()) return INFINITY;
  const auto middle = panels.begin() + static_cast<std::ptrdiff_t>(panels.size() / 2);
  std::ranges::nth_element(panels, middle, {}, &Panel::outward);
  return middle->outward;
}

std::vector<Panel> panels_of(const FaceView& view) {
  const Bow bow{1, view.half_width, view.middle};
  std::vector<Panel> panels;
  constexpr double kBeside = 1.02;  // of the half width: no panel of this face
  for (const bool all : {false, true}) {
    for (const Strip& strip : view.strips) {
      if (!all && std::abs(strip.across - view.middle) > kBeside * view.half_width) continue;
      panels.push_back({strip.outward, bow.at(strip.across)});
    }
    if (!panels.empty()) break;
  }
  return panels;
}

/// A strip's log-likelihood by how far it stands back behind the face, tabled.
class PanelLikelihood {
 public:
  PanelLikelihood(double sd, const FaceConfig& config) {
    constexpr double kAnywhere = 3;  // m
    stray_ = std::log(config.stray / kAnywhere);
    for (double behind = kFirst; behind < kLast; behind += kStep) {
      table_.push_back(log_sum(
          std::log(1 - config.stray) + log_setback(behind, config.roundness_m, sd), stray_));
    }
  }

  [[nodiscard]] double operator()(double behind) const {
    const auto at = static_cast<std::ptrdiff_t>(std::floor((behind - kFirst) / kStep + 0.5));
    return at < 0 || at >= std::ssize(table_) ? stray_ : table_[static_cast<std::size_t>(at)];
  }

 private:
  static constexpr double kFirst = -0.4, kLast = 0.6, kStep = 0.005;  // m
  double stray_;
  std::vector<double> table_;
};

/// Of the hits of a seen face, normalised over the grid, whatever its bow's depth; none far beyond
/// them.
std::vector<double> log_seen(const std::vector<double>& grid, const std::vector<Panel>& panels,
                             double hits, const FaceView& view, const FaceConfig& config) {
  constexpr double kNone = -60, kBeyond = 0.5;  // m
  constexpr int kDepths = 5;
  const double deepest = view.end ? config.bow_end_m : config.bow_side_m;
  const PanelLikelihood likelihood(std::hypot(config.noise_m, config.noise_per_m * view.range),
                                   config);
  std::vector<double> log_p(grid.size(), kNone * static_cast<double>(panels.size()));
  std::array<double, kDepths> of_depth;
  for (std::size_t i = 0; i < grid.size() && grid[i] < hits + kBeyond; ++i) {
    for (int k = 0; k < kDepths; ++k) {
      const double depth = deepest * k / (kDepths - 1);
      of_depth[k] = 0;
      for (const Panel& panel : panels)
        of_depth[k] += likelihood(grid[i] - depth * panel.back - panel.outward);
    }
    log_p[i] = log_sum(of_depth);
  }
  const double most = *std::ranges::max_element(log_p);
  double sum = 0;
  for (const double l : log_p) sum += std::exp(l - most);
  for (double& l : log_p) l -= most + std::log(sum * kCell);
  return log_p;
}

double log_normal(double off, double sd) {
  return -0.5 * off * off / (sd * sd) - std::log(sd * std::sqrt(2 * M_PI));
}

/// Of hits that only bound a face that was not seen: anywhere beyond them.
double log_bound(double face, double hits, bool end, const FaceConfig& config) {
  constexpr double kSoft = 0.05, kTail = 0.3;  // m
  const double depth = end ? config.depth_end_m : config.depth_side_m;
  return log_normal_cdf((face - hits) / kSoft) - std::log(depth) -
         std::max(face - hits - depth, 0.0) / kTail;
}

double log_free(double face, double free_m, bool end, const FaceConfig& config) {
  constexpr double kLeast = -10;  // wrong beams, or a wrong point, are not excluded
  if (!std::isfinite(free_m)) return 0;
  const double sd = end ? config.free_end_sd_m : config.free_side_sd_m;
  return std::max(kLeast, log_normal_cdf((free_m + config.free_slack_m - face) / sd));
}

/// Beams beside a face that is there go on past it: log of how much likelier they come as near as
/// they do than where something hides it, where they come near anywhere alike. Amid points of no
/// object, where they may end at the vehicle's own points, they tell as much less.
/// \param beyond  m, of the face and of all hits, within which none is looked for
double log_passed(double beyond, double passed_m, double alone, double unpassed) {
  constexpr double kAnywhere = 3;  // m
  if (!std::isfinite(beyond)) return 0;
  const double near = std::exp(-std::max(beyond, 0.0) / passed_m);
  return alone * std::log((1 - unpassed) * near * kAnywhere / passed_m + unpassed);
}

/// Of hits on a face beside it, followed to their common corner: they end short of it as corners
/// are rounded and bonnets low, and beams pass it as far from it.
double log_corner(double face, double hits, double beyond, const FaceView& view,
                  const FaceConfig& config) {
  constexpr double kSoft = 0.05;  // m
  constexpr double kShare = 0.6;  // of the deepest bow
  const double bow = view.end ? config.bow_end_m : config.bow_side_m;
  const double scale = std::max(kShare * bow, kSoft);
  return log_setback(face - hits, scale, kSoft) +
         log_passed(beyond, scale, view.alone, config.unpassed);
}

void blur(std::vector<double>& p, double sd) {
  const int reach = static_cast<int>(std::ceil(3 * sd / kCell));
  std::vector<double> kernel;
  for (int i = -reach; i <= reach; ++i)
    kernel.push_back(std::exp(-0.5 * std::pow(i * kCell / sd, 2)));
  const double sum = std::accumulate(kernel.begin(), kernel.end(), 0.0);
  std::vector<double> blurred(p.size(), 0);
  const int size = static_cast<int>(p.size());
  for (int i = 0; i < size; ++i) {
    for (int k = std::max(-reach, -i); k <= std::min(reach, size - 1 - i); ++k) {
      blurred[i] += p[i + k] * kernel[k + reach] / sum;
    }
  }
  p = std::move(blurred);
}

}  // namespace

double log_sum(double a, double b) {
  const double most = std::max(a, b);
  return most + std::log(std::exp(a - most) + std::exp(b - most));
}

double log_sum(std::span<const double> values) {
  const double most = *std::ranges::max_element(values);
  double sum = 0;
  for (const double value : values) sum += std::exp(value - most);
  return most + std::log(sum);
}

FaceStrips strips_along(const Places& places, int axis, const FaceConfig& config) {
  const Strips strips(places, axis, config.strip_m);
  FaceStrips faces;
  set_reach(strips, faces);
  std::vector<LayerSum> sums(strips.ranges.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const int strip = strips.strip_of[i];
    const double at = places[i][axis];
    LayerSum& sum = sums[strip];
    ++sum.all;
    if (at < strips.ranges[strip].low + config.layer_m) sum.low += at, ++sum.lows;
    if (at > strips.ranges[strip].high - config.layer_m) sum.high += at, ++sum.highs;
  }
  constexpr std::size_t kDense = 3;  // points a strip and more: a lone one is none
  const int least = places.size() < kDense * sums.size() ? 1 : 2;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (sums[i].all < least) continue;
    faces.low.push_back({strips.across(i), -sums[i].low / sums[i].lows});
    faces.high.push_back({strips.across(i), sums[i].high / sums[i].highs});
  }
  return faces;
}

double log_flat(const std::vector<Strip>& strips, const FaceConfig& config) {
  constexpr double kOnFace = 0.6;  // share of strips; the others' layers lie anywhere
  if (strips.empty()) return 0;
  std::vector<double> outward;
  for (const Strip& strip : strips) outward.push_back(strip.outward);
  const double face = together(outward);
  double sum = 0;
  for (const double u : outward) {
    const double on = kOnFace * std::exp(log_normal(u - face, config.side_m));
    sum += std::log(on + 1 - kOnFace);
  }
  return sum;
}

double outermost(const std::vector<Strip>& strips) { return second_outermost(strips); }

FaceDensity face_density(const FaceView& view, double free_m, const FaceConfig& config) {
  const std::vector<Panel> panels = panels_of(view);
  const double hits = std::max(view.hits, second_outermost(panels));
  std::vector<double> grid;
  const double first = std::min(hits, middle_place(panels)) - kWithin;
  const double last = hits + (view.end ? kFarthest : kWidest);
  for (double at = std::floor(first / kCell) * kCell; at < last; at += kCell) grid.push_back(at);
  const std::vector<double> seen = log_seen(grid, panels, hits, view, config);
  constexpr double kLeast = 1e-4;
  const double log_in = std::log(std::max(view.seen, kLeast));
  const double unseen = std::max(1 - view.seen, kLeast), corner = std::max(view.corner, kLeast);
  const double log_corner_share = std::log(unseen * corner);
  const double log_out = std::log(unseen * (1 - corner));
  FaceDensity density{grid.front(), std::vector<double>(grid.size()), 0};
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const double at = grid[i], beyond = free_m - std::max(at, hits);
    density.probability[i] =
        log_sum(log_in + seen[i] + log_passed(beyond, config.passed_m, view.alone, config.unpassed),
                log_sum(log_corner_share + log_corner(at, hits, beyond, view, config),
                        log_out + log_bound(at, hits, view.end, config))) +
        log_free(at, free_m, view.end, config);
  }
  density.log_scale = *std::ranges::max_element(density.probability);
  for (double& p : density.probability) p = std::exp(p - density.log_scale);
  blur(density.probability, config.shape_sd_m);
  return density;
}

SizeDensity::SizeDensity(const FaceDensity& low, const FaceDensity& high)
    : first_size_(low.first + high.first), log_scale_(low.log_scale + high.log_scale) {
  constexpr double kNone = 1e-7;
  sums_.assign(low.probability.size() + high.probability.size() - 1, {0, 0, 0});
  for (std::size_t i = 0; i < low.probability.size(); ++i) {
    const double p_low = low.probability[i];
    if (p_low < kNone) continue;
    const double at = low.first + static_cast<double>(i) * kCell;
    for (std::size_t j = 0; j < high.probability.size(); ++j) {
      const double p = p_low * high.probability[j];
      std::array<double, 3>& sum = sums_[i + j];
      sum[0] += p;
      sum[1] += p * at;
      sum[2] += p * at * at;
    }
  }
}

SizeDensity::Moments SizeDensity::with(const Normal& prior) const {
  double sum = 1e-300, low = 0, low_low = 0, size = 0, size_size = 0, low_size = 0;
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    if (sums_[i][0] == 0) continue;
    const double s = first_size_ + static_cast<double>(i) * kCell;
    const double z = (s - prior.mean) / prior.sd;
    const double weight = std::exp(-0.5 * z * z);
    sum += weight * sums_[i][0];
    low += weight * sums_[i][1];
    low_low += weight * sums_[i][2];
    size += weight * s * sums_[i][0];
    size_size += weight * s * s * sums_[i][0];
    low_size += weight * s * sums_[i][1];
  }
  Moments moments;
  moments.log_evidence = log_scale_ + std::log(sum * kCell * kCell / prior.sd);
  const double e_low = low / sum, e_size = size / sum;
  moments.mean = {e_low, e_size - e_low};
  const double ll = low_low / sum, lh = low_size / sum - ll;
  const double hh = size_size / sum - 2 * low_size / sum + ll;
  moments.second << ll, lh, lh, hh;
  return moments;
}

}  // namespace saker::detection
