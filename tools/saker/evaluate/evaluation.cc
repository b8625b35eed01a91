#include "tools/saker/evaluate/evaluation.h"

#include <fmt/format.h>

#include <cmath>

#include "saker/core/statistics.h"

namespace saker::tools {
namespace {

using Json = nlohmann::ordered_json;

/// A figure of nothing is null.
Json number(double value, double steps = 1e6) {
  if (!std::isfinite(value)) return nullptr;
  return std::nearbyint(value * steps) / steps;
}

Json class_json(const ClassPoints& points) {
  return {{"iou", number(points.iou())},
          {"precision", number(points.precision())},
          {"recall", number(points.recall())},
          {"labelled_points", points.labelled},
          {"predicted_points", points.predicted}};
}

Json points_json(const SegmentationFigures& points, const objects::ClassTable& table) {
  Json classes = Json::object(), labels = Json::object(), bins = Json::array();
  for (std::size_t id = 1; id < points.classes().size(); ++id) {
    classes[table.classes[id].name] = class_json(points.classes()[id]);
  }
  for (const auto& [id, label] : points.labels()) {
    const double recall = static_cast<double>(label.right) / static_cast<double>(label.points);
    labels[std::to_string(id)] = {{"class", table[label.class_id].name},
                                  {"points", label.points},
                                  {"recall", number(recall)}};
  }
  for (std::size_t i = 0; i < points.bins().size(); ++i) {
    const ProbabilityBin& bin = points.bins()[i];
    const auto count = static_cast<double>(bin.points);
    const double width = 1.0 / static_cast<double>(points.bins().size());
    bins.push_back({{"from", number(width * static_cast<double>(i))},
                    {"to", number(width * static_cast<double>(i + 1))},
                    {"points", bin.points},
                    {"probability", number(bin.sum / count)},
                    {"right", number(static_cast<double>(bin.right) / count)}});
  }
  return {{"classes", classes},
          {"labels", labels},
          {"calibration",
           {{"expected_error", number(points.expected_calibration_error())}, {"bins", bins}}}};
}

Json boxes_json(const BoxFigures& boxes) {
  Json kinds = Json::object();
  for (const auto& [kind, figures] : boxes.kinds()) {
    kinds[kind] = {{"boxes", figures.boxes},
                   {"recognised", figures.recognised},
                   {"recall", number(figures.recall())},
                   {"mean_share", number(figures.mean_share())},
                   {"vehicles", figures.vehicles.size()},
                   {"recognised_vehicles", figures.recognised_vehicles()}};
  }
  return {{"boxes", kinds},
          {"box_points",
           {{"called", boxes.called_points()}, {"precision", number(boxes.point_precision())}}}};
}

/// By labels where a scan has them, else by boxes, and then only where they are labelled.
std::vector<PointVerdict> verdicts(const std::vector<bool>& called,
                                   const std::vector<std::uint32_t>* ids,
                                   const SegmentationFigures& points,
                                   const std::vector<bool>& labelled_vehicle,
                                   const BoxJudgement& boxes) {
  std::vector<PointVerdict> result(called.size(), PointVerdict::other);
  for (std::size_t i = 0; i < called.size(); ++i) {
    if (ids != nullptr ? !points.counts((*ids)[i]) : !boxes.judged[i]) continue;
    const bool vehicle = ids != nullptr ? labelled_vehicle[i] : boxes.in_counted[i];
    const bool allowed = ids != nullptr ? vehicle : boxes.in_box[i];
    if (called[i]) result[i] = allowed ? PointVerdict::right : PointVerdict::wrong;
    if (!called[i] && vehicle) result[i] = PointVerdict::missed;
  }
  return result;
}

std::string cell(const Json& value) {
  return value.is_null() ? "-" : fmt::format("{:.3f}", value.get<double>());
}

std::string class_table(const Json& figures) {
  std::string text = "class         IoU  precision  recall      points\n";
  for (const auto& [name, row] : figures["classes"].items()) {
    text += fmt::format("{:10}  {:>5}      {:>5}   {:>5}  {:10}\n", name, cell(row["iou"]),
                        cell(row["precision"]), cell(row["recall"]),
                        row["labelled_points"].get<std::int64_t>());
  }
  text += "\nlabel  class       recall      points\n";
  for (const auto& [id, row] : figures["labels"].items()) {
    text += fmt::format("{:>5}  {:10}   {:>5}  {:10}\n", id, row["class"].get<std::string>(),
                        cell(row["recall"]), row["points"].get<std::int64_t>());
  }
  return text;
}

std::string reliability_table(const Json& calibration) {
  std::string text =
      fmt::format("\nexpected calibration error {}\nprobability     points    mean   right\n",
                  cell(calibration["expected_error"]));
  for (const Json& bin : calibration["bins"]) {
    text += fmt::format("{:.2f} - {:.2f} {:10}   {:>5}   {:>5}\n", bin["from"].get<double>(),
                        bin["to"].get<double>(), bin["points"].get<std::int64_t>(),
                        cell(bin["probability"]), cell(bin["right"]));
  }
  return text;
}

std::string box_table(const Json& figures) {
  std::string text = "boxes     recognised  recall  mean share  vehicles\n";
  for (const auto& [kind, row] : figures["boxes"].items()) {
    text += fmt::format("{:8} {:5} of {:<5} {:>5}       {:>5}  {} of {}\n", kind,
                        row["recognised"].get<int>(), row["boxes"].get<int>(), cell(row["recall"]),
                        cell(row["mean_share"]), row["recognised_vehicles"].get<int>(),
                        row["vehicles"].get<int>());
  }
  return text + fmt::format("precision of {} points called vehicle: {}\n",
                            figures["box_points"]["called"].get<long>(),
                            cell(figures["box_points"]["precision"]));
}

}  // namespace

bool Evaluation::is_vehicle(objects::ClassId id) const {
  return table_[id].shape == objects::Shape::cuboid;
}

std::vector<bool> Evaluation::called(const lidar::Labels& labels) const {
  std::vector<bool> result;
  result.reserve(labels.classes.size());
  for (const objects::ClassId id : labels.classes) result.push_back(is_vehicle(id));
  return result;
}

void Evaluation::add(const std::string& name, const lidar::Scan& scan, const lidar::Labels& labels,
                     const std::vector<std::uint32_t>* ids, const std::vector<LabelledBox>* boxes,
                     std::optional<float> half_angle_deg, double ms) {
  const std::vector<bool> vehicle = called(labels);
  std::vector<bool> labelled(vehicle.size(), false);
  ms_.push_back(ms);
  if (ids != nullptr) {
    has_labels_ = true;
    points_.add(labels, *ids);
    for (std::size_t i = 0; i < ids->size(); ++i) {
      labelled[i] = is_vehicle(points_.class_of((*ids)[i]));
    }
  }
  EvaluatedScan evaluated{name, {}, {}, {}};
  BoxJudgement judgement;
  if (boxes != nullptr) {
    has_boxes_ = true;
    judgement = boxes_.add(scan.points, vehicle, *boxes, half_angle_deg);
    evaluated.boxes = *boxes;
    evaluated.box_verdicts = judgement.boxes;
  }
  const auto verdict = verdicts(vehicle, ids, points_, labelled, judgement);
  for (std::size_t i = 0; i < verdict.size(); ++i) {
    evaluated.points[static_cast<std::size_t>(verdict[i])].emplace_back(scan.points[i].head<2>());
  }
  worst_.add(std::move(evaluated));
}

Json Evaluation::json() const {
  Json figures = {{"scans", ms_.size()},
                  {"ms_a_scan",
                   {{"median", number(core::median(ms_), 10)},
                    {"p95", number(core::percentile(ms_, 0.95), 10)}}}};
  if (has_labels_) figures.update(points_json(points_, table_));
  if (has_boxes_) figures.update(boxes_json(boxes_));
  figures["worst"] = Json::array();
  for (const EvaluatedScan& scan : worst()) {
    figures["worst"].push_back({{"scan", scan.name},
                                {"right_points", scan.points[0].size()},
                                {"missed_points", scan.missed()},
                                {"wrong_points", scan.wrong()}});
  }
  return figures;
}

std::string evaluation_text(const Json& figures) {
  std::string text = fmt::format(
      "{} scans, {:.1f} ms a scan (median; 95 %: {:.1f})\n\n", figures["scans"].get<int>(),
      figures["ms_a_scan"]["median"].get<double>(), figures["ms_a_scan"]["p95"].get<double>());
  if (figures.contains("classes")) {
    text += class_table(figures) + reliability_table(figures["calibration"]);
  }
  if (figures.contains("classes") && figures.contains("boxes")) text += "\n";
  if (figures.contains("boxes")) text += box_table(figures);
  return text;
}

std::string window_text(const Json& windows) {
  std::string text = fmt::format(
      "\nsingle windows: {} of {} measured, MAE of length {} m, width {} m; one box {} m\n"
      "range m   angle deg  measured  length   width  one box\n",
      windows["measured"].get<int>(), windows["labelled"].get<int>(), cell(windows["length_mae_m"]),
      cell(windows["width_mae_m"]), cell(windows["box_size_mae_m"]));
  for (const Json& row : windows["cells"]) {
    text += fmt::format("{:2} … {:2}   {:2} … {:2}   {:4} of {:<4} {:>5}   {:>5}   {:>5}\n",
                        row["range_m"][0].get<double>(), row["range_m"][1].get<double>(),
                        row["angle_deg"][0].get<double>(), row["angle_deg"][1].get<double>(),
                        row["measured"].get<int>(), row["labelled"].get<int>(),
                        cell(row["length_mae_m"]), cell(row["width_mae_m"]),
                        cell(row["box_size_mae_m"]));
  }
  return text;
}

}  // namespace saker::tools
