#include "tools/saker/replay/network_fit.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "saker/core/error.h"

namespace saker::tools {

std::string network_fit_note(const autonomy::SegmentationFit& fit,
                             const std::filesystem::path& description) {
  double probability = 0, share = 0;
  try {
    const YAML::Node bounds = YAML::LoadFile(description.string())["fit"];
    if (!bounds) return "";
    probability = bounds["least_probability"].as<double>();
    share = bounds["least_classified_share"].as<double>();
  } catch (const YAML::Exception&) {
    throw Error(description.string() +
                ": fit: expected least_probability and least_classified_share");
  }
  const bool sure = !(fit.probability < probability);  // nothing to say of no scan at all
  const bool classified = !(fit.classified_share < share);
  if (sure && classified) return "";
  return fmt::format(
      "the network does not fit this sensor or place: {:.0f} % of the points have a class, with "
      "probability {:.2f}; expected {:.0f} % and {:.2f}: objects are in doubt",
      100 * fit.classified_share, fit.probability, 100 * share, probability);
}

}  // namespace saker::tools
