#include "tools/saker/evaluate/labelled_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "saker/core/error.h"
#include "saker/core/files.h"
#include "tools/saker/evaluate/json_file.h"

namespace saker::tools {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kIdBits = 0xFFFF;  // the upper ones say which instance

bool holds_labels(const fs::path& folder) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".label") return true;
  }
  return false;
}

/// Identities are texts in some data sets and numbers in others.
std::string identity(const JsonNode& box) {
  if (!box.has("id")) return "";
  const JsonNode id = box.at("id");
  return id.is_text() ? id.text() : fmt::format("{}", id.number());
}

std::vector<LabelledBox> read_boxes(const JsonNode& list) {
  std::vector<LabelledBox> boxes;
  list.each_element([&boxes](const JsonNode& entry) {
    const auto kind = vehicle_kind(entry.at("class").text());
    LabelledBox box;
    box.position = Eigen::Vector3d(entry.at("position").numbers(3).data());
    box.size = Eigen::Vector3d(entry.at("size").numbers(3).data());
    box.yaw = entry.at("yaw").number();
    box.vehicle = identity(entry);
    if (!kind) return;
    box.kind = *kind;
    boxes.push_back(box);
  });
  return boxes;
}

}  // namespace

LabelledFolder::LabelledFolder(const fs::path& folder) {
  if (holds_labels(folder / "labels")) labels_ = folder / "labels";
  const fs::path boxes = folder / "boxes.json", view = folder / "field_of_view.json";
  if (labels_.empty() && !fs::exists(boxes)) {
    throw Error(fmt::format("{}: nothing is labelled, expected labels/*.label or boxes.json",
                            folder.string()));
  }
  if (fs::exists(boxes)) {
    const nlohmann::json document = read_json(boxes);
    JsonNode(document, boxes.string())
        .each_field([this](const std::string& scan, const JsonNode& list) {
          boxes_[scan] = read_boxes(list);
        });
  }
  if (!fs::exists(view)) return;
  const nlohmann::json document = read_json(view);
  JsonNode(document, view.string())
      .each_field([this](const std::string& key, const JsonNode& value) {
        all_limited_ |= key == "half_angle_deg";
        if (key == "half_angle_deg") half_angle_deg_ = static_cast<float>(value.number());
        limited_.insert(key);
      });
}

std::optional<std::vector<std::uint32_t>> LabelledFolder::ids(const std::string& scan,
                                                              std::size_t points) const {
  const fs::path file = labels_ / (scan + ".label");
  if (labels_.empty() || !fs::exists(file)) return std::nullopt;
  const std::string bytes = core::read_file(file);
  if (bytes.size() != points * sizeof(std::uint32_t)) {
    throw Error(fmt::format("{}: {} bytes, expected {}: 4 for each of the scan's {} points",
                            file.string(), bytes.size(), points * sizeof(std::uint32_t), points));
  }
  std::vector<std::uint32_t> ids(points);
  std::memcpy(ids.data(), bytes.data(), bytes.size());
  for (std::uint32_t& id : ids) id &= kIdBits;
  return ids;
}

const std::vector<LabelledBox>* LabelledFolder::boxes(const std::string& scan) const {
  const auto found = boxes_.find(scan);
  return found == boxes_.end() ? nullptr : &found->second;
}

std::optional<float> LabelledFolder::half_angle_deg(const std::string& scan) const {
  if (!all_limited_ && !limited_.contains(scan)) return std::nullopt;
  return half_angle_deg_;
}

}  // namespace saker::tools
