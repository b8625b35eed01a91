#include "tools/saker/picture/evaluation_picture.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/saker/picture/picture.h"

namespace saker::tools {
namespace {

constexpr double kReach_m = 45;  // shown around the sensor
constexpr Colour kOther{190, 196, 204};
constexpr std::array<Colour, 4> kPointColours = {colours::kGreen, colours::kOrange,
                                                 colours::kPurple, kOther};

Colour colour_of(BoxJudgement::Of verdict) {
  switch (verdict) {
    case BoxJudgement::Of::recognised:
      return colours::kBlue;
    case BoxJudgement::Of::missed:
      return colours::kOrange;
    case BoxJudgement::Of::uncounted:
      break;
  }
  return colours::kGrey;
}

std::vector<Eigen::Vector2d> plane(const std::vector<Eigen::Vector2f>& points) {
  std::vector<Eigen::Vector2d> result;
  result.reserve(points.size());
  for (const Eigen::Vector2f& p : points) result.emplace_back(p.cast<double>());
  return result;
}

}  // namespace

void WorstScans::add(EvaluatedScan scan) {
  if (scan.faults() == 0) return;
  const auto place = std::ranges::find_if(
      scans_, [&](const EvaluatedScan& s) { return s.faults() < scan.faults(); });
  scans_.insert(place, std::move(scan));
  if (scans_.size() > most_) scans_.pop_back();
}

void write_evaluation_picture(const std::filesystem::path& file, const EvaluatedScan& scan) {
  Picture picture({Eigen::Vector2d::Constant(-kReach_m), Eigen::Vector2d::Constant(kReach_m)});
  for (const std::size_t verdict : {3U, 0U, 2U, 1U}) {  // what was missed lies on top
    picture.points(plane(scan.points[verdict]), kPointColours[verdict], verdict == 3 ? 0.25 : 0.8);
  }
  for (std::size_t i = 0; i < scan.boxes.size(); ++i) {
    const LabelledBox& box = scan.boxes[i];
    picture.rectangle(box.position.head<2>(), box.yaw, box.size.x(), box.size.y(),
                      colour_of(scan.box_verdicts[i]));
  }
  picture.disc(Eigen::Vector2d::Zero(), 5, colours::kYellow);
  picture.title(fmt::format("Scan {} from above: {} vehicle points right, {} missed, {} wrong",
                            scan.name, scan.points[0].size(), scan.missed(), scan.wrong()));
  std::vector<LegendEntry> legend = {{Mark::dot, colours::kGreen, "vehicle, right"},
                                     {Mark::dot, colours::kOrange, "vehicle, missed"},
                                     {Mark::dot, colours::kPurple, "called vehicle, is none"},
                                     {Mark::dot, kOther, "other"},
                                     {Mark::dot, colours::kYellow, "sensor"}};
  if (!scan.boxes.empty()) {
    legend.push_back({Mark::rectangle, colours::kBlue, "box recognised"});
    legend.push_back({Mark::rectangle, colours::kOrange, "box missed"});
    legend.push_back({Mark::rectangle, colours::kGrey, "box not counted"});
  }
  picture.legend(legend);
  picture.save(file);
}

}  // namespace saker::tools
