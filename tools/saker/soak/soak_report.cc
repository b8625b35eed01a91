#include "tools/saker/soak/soak_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "tools/saker/picture/chart.h"

namespace saker::tools {
namespace {

constexpr double kWarmUp = 0.2;           // share of the time
constexpr std::size_t kMostSamples = 40;  // of a trend

/// Names in the order in which they are met.
std::vector<std::string> processes_of(const std::vector<SoakSample>& samples) {
  std::vector<std::string> names;
  for (const SoakSample& sample : samples) {
    if (std::ranges::find(names, sample.process) == names.end()) names.push_back(sample.process);
  }
  return names;
}

Series series_of(const std::vector<SoakSample>& samples, double SoakSample::*figure) {
  Series series;
  for (const SoakSample& sample : samples) {
    if (!std::isfinite(sample.*figure)) continue;
    series.times.push_back(sample.t_h);
    series.values.push_back(sample.*figure);
  }
  return series;
}

Trend trend_in(const std::vector<SoakSample>& samples, double SoakSample::*figure) {
  const Series series = thinned(settled(series_of(samples, figure), kWarmUp), kMostSamples);
  return trend_of(series.times, series.values);
}

SoakFigures figures_of_one(const std::vector<SoakSample>& samples) {
  SoakFigures figures{.process = samples.front().process,
                      .samples = static_cast<int>(samples.size()),
                      .hours = samples.back().t_h - samples.front().t_h,
                      .memory = trend_in(samples, &SoakSample::memory_mb),
                      .work = trend_in(samples, &SoakSample::work),
                      .handles_first = samples.front().handles,
                      .handles_last = samples.back().handles};
  std::vector<double> handles;
  for (const SoakSample& sample : samples) {
    handles.push_back(sample.handles);
    figures.handles_most = std::max(figures.handles_most, sample.handles);
    figures.threads_most = std::max(figures.threads_most, sample.threads);
    figures.waiting_most = std::fmax(figures.waiting_most, sample.waiting);
  }
  figures.handles_grow = floor_rises(handles);
  return figures;
}

/// The longest of 1, 2, 5 × 10ⁿ that parts `span` into five at least.
double step_of(double span) {
  const double most = span / 5, decade = std::pow(10, std::floor(std::log10(most)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * decade <= most) return factor * decade;
  }
  return decade;
}

}  // namespace

std::string SoakFigures::shortfall() const {
  const double percent = memory.in_percent(memory.low);
  if (percent > kMostPercent) {
    return fmt::format("{}: memory grows by {:.2f} % an hour at least", process, percent);
  }
  if (handles_grow) {
    return fmt::format("{}: open handles grow, {} at first, {} at last", process, handles_first,
                       handles_last);
  }
  return "";
}

std::vector<SoakFigures> figures_of(const std::vector<SoakSample>& samples) {
  std::vector<SoakFigures> all;
  for (const std::string& name : processes_of(samples)) {
    std::vector<SoakSample> own;
    std::ranges::copy_if(samples, std::back_inserter(own),
                         [&](const SoakSample& sample) { return sample.process == name; });
    all.push_back(figures_of_one(own));
  }
  return all;
}

std::string soak_table(const std::vector<SoakFigures>& figures) {
  std::string text =
      fmt::format("{:24} {:>6} {:>8} {:>9} {:>9} {:>18} {:>13} {:>7} {:>8} {:>7} {:>8}\n",
                  "process", "hours", "samples", "memory MB", "% an hour", "interval", "handles",
                  "threads", "waiting", "s/s", "% an hour");
  for (const SoakFigures& f : figures) {
    text += fmt::format(
        "{:24} {:6.2f} {:8} {:9.1f} {:9.2f} {:>18} {:>13} {:7} {:8.0f} {:7.2f} {:8.1f}\n",
        f.process, f.hours, f.samples, f.memory.level, f.memory.in_percent(f.memory.slope),
        fmt::format("{:.2f} to {:.2f}", f.memory.in_percent(f.memory.low),
                    f.memory.in_percent(f.memory.high)),
        fmt::format("{} to {}", f.handles_first, f.handles_last), f.threads_most, f.waiting_most,
        f.work.level, f.work.in_percent(f.work.slope));
  }
  return text;
}

void write_soak_picture(const std::filesystem::path& file, const std::vector<SoakSample>& samples) {
  constexpr Colour kColours[] = {colours::kBlue, colours::kOrange, colours::kGreen,
                                 colours::kPurple};
  double most_mb = 1, most_h = 1e-3;
  for (const SoakSample& sample : samples) {
    most_mb = std::fmax(most_mb, 1.1 * sample.memory_mb);
    most_h = std::max(most_h, sample.t_h);
  }
  Chart chart("Resident memory", {"time, h", 0, most_h, step_of(most_h)},
              {"MB", 0, most_mb, step_of(most_mb)});
  std::vector<LegendEntry> legend;
  for (const std::string& name : processes_of(samples)) {
    std::vector<Eigen::Vector2d> points;
    for (const SoakSample& sample : samples) {
      if (sample.process == name) points.emplace_back(sample.t_h, sample.memory_mb);
    }
    const Colour colour = kColours[legend.size() % std::size(kColours)];
    chart.curve(points, colour);
    chart.dots(points, colour);
    legend.push_back({Mark::line, colour, name});
  }
  chart.legend(legend);
  chart.save(file);
}

}  // namespace saker::tools
