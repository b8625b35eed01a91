#include "tools/saker/picture/model_pictures.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "saker/core/statistics.h"
#include "saker/uncertainty/regions.h"
#include "tools/saker/picture/chart.h"
#include "tools/saker/picture/picture.h"

namespace saker::tools {
namespace {

using Points = std::vector<Eigen::Vector2d>;
using uncertainty::Model;
using uncertainty::View;

constexpr double kGrid_m = 0.25;
constexpr Colour kCurves[] = {colours::kBlue, colours::kGreen, colours::kOrange, colours::kPurple};

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

/// Centres of the grid around an object at the origin that were flown.
Points flown_places(const Model& model, objects::ClassId id) {
  const double far = model.of(id).geometric.parts().intervals.range_edges.back();
  Points places;
  for (double x = -far; x <= far; x += kGrid_m) {
    for (double y = -far; y <= far; y += kGrid_m) {
      const View view{std::hypot(x, y), std::atan2(y, x), NAN, NAN};
      if (!model.predict(id, view).extrapolated) places.emplace_back(x, y);
    }
  }
  return places;
}

/// Dark grey at 0, white at 1.
Colour grey(double value) {
  const auto level = static_cast<std::uint8_t>(70 + 180 * std::clamp(value, 0.0, 1.0));
  return {level, level, level};
}

/// One of the paper's regions: what lies in it in colour, the rest in grey by `value`.
void write_region(const std::filesystem::path& file, const std::string& title, const Points& places,
                  const std::function<double(const View&)>& value,
                  const std::function<bool(const View&)>& in_region) {
  Extent extent;
  for (const Eigen::Vector2d& p : places) extent.include(p);
  Picture picture(extent.grown(1), 700);
  for (const Eigen::Vector2d& p : places) {
    const View view{p.norm(), std::atan2(p.y(), p.x()), NAN, NAN};
    picture.disc(p, 3, in_region(view) ? colours::kSky : grey(value(view)));
  }
  picture.rectangle(Eigen::Vector2d::Zero(), 0, 4.5, 1.8, colours::kOrange);
  picture.title(title);
  picture.legend({{Mark::dot, colours::kSky, "in the region"},
                  {Mark::dot, grey(0.3), "not, darker is worse"}});
  picture.save(file);
}

void write_regions(const std::filesystem::path& folder, const Model& model, objects::ClassId id,
                   const std::string& name) {
  const uncertainty::Regions regions({}, model, id);
  const Points places = flown_places(model, id);
  const auto confidence = [&](const View& view) { return model.predict(id, view).confidence; };
  const auto small = [&](const View& view) { return regions.small_error_probability(view); };
  const auto said = [](double threshold, bool relative) {
    return fmt::format("{:.2f}{}", threshold, relative ? " (best share)" : "");
  };
  write_region(folder / (name + "_confidence.png"),
               fmt::format("{}: confidence >= {}", name,
                           said(regions.least_confidence(), regions.relative_confidence())),
               places, confidence, [&](const View& view) { return regions.confident(view); });
  write_region(folder / (name + "_errors.png"),
               fmt::format("{}: P(place < 0.1 m, size < 0.2 m) >= {}", name,
                           said(regions.least_probability(), regions.relative_probability())),
               places, small, [&](const View& view) { return regions.precise(view); });
  write_region(folder / (name + "_both.png"), name + ": both", places, small,
               [&](const View& view) { return regions.contains(view); });
}

/// Of the errors of one view: what it alone tells of an object.
double entropy(const Eigen::MatrixXd& covariance, const Eigen::MatrixXd& common) {
  return 0.5 * std::log((covariance + common).determinant());
}

/// Mean over the intervals that were flown along the other axis.
double mean_entropy(const Model& model, objects::ClassId id, const std::vector<View>& views) {
  std::vector<double> values;
  for (const View& view : views) {
    const uncertainty::Prediction prediction = model.predict(id, view);
    if (prediction.extrapolated) continue;
    values.push_back(entropy(prediction.covariance, model.common_covariance(id)));
  }
  return core::mean(values);
}

std::vector<View> views_at_range(const uncertainty::Intervals& intervals, double range) {
  std::vector<View> views;
  for (int sector = 0; sector < intervals.sectors; ++sector) {
    const double angle = intervals.sectors > 1 ? intervals.sector_centre(sector) : 0;
    views.push_back({range, angle, NAN, NAN});
  }
  return views;
}

std::vector<View> views_at_angle(const uncertainty::Intervals& intervals, double angle) {
  std::vector<View> views;
  for (int range = 0; range < intervals.ranges(); ++range) {
    views.push_back({intervals.range_centre(range), angle, NAN, NAN});
  }
  return views;
}

/// Curve and fitted intervals of one class.
struct Entropies {
  Points curve, dots;
};

enum class Over { range, angle };

Entropies entropies_of(const Model& model, objects::ClassId id, Over over) {
  constexpr int kSteps = 180;
  const auto& parts = model.of(id).geometric.parts();
  const uncertainty::Intervals& intervals = parts.intervals;
  Entropies entropies;
  const double near = intervals.range_edges.front(), far = intervals.range_edges.back();
  for (int i = 0; i <= kSteps; ++i) {
    const double share = static_cast<double>(i) / kSteps;
    if (over == Over::range) {
      const double range = near + share * (far - near);
      entropies.curve.emplace_back(range,
                                   mean_entropy(model, id, views_at_range(intervals, range)));
    } else {
      const double angle = share * std::numbers::pi;
      entropies.curve.emplace_back(degrees(angle),
                                   mean_entropy(model, id, views_at_angle(intervals, angle)));
    }
  }
  for (int i = 0; i < intervals.size(); ++i) {
    const auto& interval = parts.fitted[static_cast<std::size_t>(i)];
    if (interval.objects == 0) continue;
    const double at = over == Over::range ? intervals.range_centre(i / intervals.sectors)
                                          : degrees(intervals.sector_centre(i % intervals.sectors));
    entropies.dots.emplace_back(at, entropy(interval.covariance, parts.common));
  }
  return entropies;
}

void write_entropy(const std::filesystem::path& file, const Model& model,
                   const objects::ClassTable& table, Over over) {
  std::vector<std::pair<std::string, Entropies>> classes;
  double low = INFINITY, high = -INFINITY;
  for (const auto& [id, own] : model.classes()) {
    if (over == Over::angle && own.geometric.parts().intervals.sectors == 1) continue;
    classes.emplace_back(table[id].name, entropies_of(model, id, over));
    for (const Eigen::Vector2d& dot : classes.back().second.dots) {
      low = std::min(low, dot.y());
      high = std::max(high, dot.y());
    }
  }
  if (!(low <= high)) return;
  const Axis y{"1/2 ln det of the covariance", std::floor(low), std::ceil(high), 1};
  const Axis x = over == Over::range ? Axis{"range, m", 0, 20, 2}
                                     : Axis{"viewing angle from the front, degrees", 0, 180, 30};
  Chart chart(over == Over::range ? "Geometric entropy against range, mean over the angles"
                                  : "Geometric entropy against angle, mean over the ranges",
              x, y);
  std::vector<LegendEntry> legend;
  for (std::size_t i = 0; i < classes.size(); ++i) {
    const Colour colour = kCurves[i % std::size(kCurves)];
    chart.dots(classes[i].second.dots, colour);
    chart.curve(classes[i].second.curve, colour);
    legend.push_back({Mark::line, colour, classes[i].first + " (dots: intervals)"});
  }
  chart.legend(legend);
  chart.save(file);
}

}  // namespace

void write_model_pictures(const std::filesystem::path& folder, const Model& model,
                          const objects::ClassTable& table) {
  for (const auto& [id, own] : model.classes()) {
    if (table[id].shape == objects::Shape::cuboid) write_regions(folder, model, id, table[id].name);
  }
  write_entropy(folder / "entropy_range.png", model, table, Over::range);
  write_entropy(folder / "entropy_angle.png", model, table, Over::angle);
}

}  // namespace saker::tools
