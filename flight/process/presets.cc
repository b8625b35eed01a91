#include "flight/process/presets.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "saker/core/error.h"

namespace saker::flight {
namespace {

/// The paper: vehicles are rectangles of the hull (III-A), whatever of them was seen, the noise is
/// fixed and equation 1 as it is; targets are those of the prior map. The model is fitted to
/// flights with these settings, from every window.
void paper(ProcessConfig& config) {
  autonomy::Config& c = config.autonomy;
  c.detection.vehicle.fitter = detection::VehicleFitting::hull;
  c.slam.measurement_noise = slam::NoiseSource::fixed;
  c.slam.noise.share_ends = false;  // an end is where the hull's is
  c.slam.graph.hidden_ends.enabled = false;
  c.active.policy = active::PolicyName::paper;
  c.active.region.best_share = 1;  // no view reaches the paper's value: all may be flown to
  c.active.paper.sampling = active::Sampling::uniform;  // such a region has one centroid
  c.active.discovery.most = 0;  // what is met beside the targets is mapped in passing
  c.uncertainty.model = "models/uncertainty-replica.yaml";
  config.fit.every_window = true;
  config.fit.cuboid_bias = true;
}

/// The baseline of the paper's table: each target is visited from one side.
void visit(ProcessConfig& config) { config.autonomy.active.policy = active::PolicyName::visit; }

constexpr std::array<Preset, 2> kPresets = {{
    {"paper", paper},
    {"visit", visit},
}};

std::string names() {
  std::string text;
  for (const Preset& preset : kPresets)
    text += (text.empty() ? "" : ", ") + std::string(preset.name);
  return text;
}

}  // namespace

std::span<const Preset> presets() { return kPresets; }

ProcessConfig with_preset(const std::string& name) {
  ProcessConfig config;
  if (name.empty()) return config;
  const auto preset = std::ranges::find(kPresets, name, &Preset::name);
  if (preset == kPresets.end()) {
    throw Error(fmt::format("--preset {}: unknown, expected one of {}", name, names()));
  }
  preset->apply(config);
  return config;
}

}  // namespace saker::flight
