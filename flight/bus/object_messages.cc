#include "flight/bus/object_messages.h"

#include <algorithm>
#include <numeric>

#include "flight/bus/fields.h"
#include "flight/bus/messages.h"

namespace saker::flight {
namespace {

using objects::Cuboid;
using objects::Cylinder;
using objects::Detections;
using objects::MapObject;
using objects::Measurement;

constexpr int kFarewells = 3;  // messages in which an object is said to be gone

/// Writes pose, size and shape; Message is map_object_t or detection_t.
template <class Message>
void write_model(const objects::Model& model, Message& message) {
  if (const auto* cuboid = std::get_if<Cuboid>(&model)) {
    message.shape = Message::CUBOID;
    write_pose(cuboid->pose, message.position, message.orientation);
    write_field(cuboid->size, message.size);
    return;
  }
  const auto& cylinder = std::get<Cylinder>(model);
  message.shape = Message::CYLINDER;
  write_field(cylinder.root, message.position);
  const auto upright = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), cylinder.axis);
  write_rotation(upright, message.orientation);
  write_field(Eigen::Vector3d(2 * cylinder.radius, 2 * cylinder.radius, cylinder.height),
              message.size);
}

template <class Message>
std::optional<objects::Model> model_of(const Message& message) {
  const auto pose = pose_of(message.position, message.orientation);
  const Eigen::Vector3d size = vector_of(message.size);
  if (!pose || !size.allFinite()) return std::nullopt;
  if (message.shape == Message::CUBOID) return Cuboid{.pose = *pose, .size = size};
  if (message.shape != Message::CYLINDER) return std::nullopt;
  return Cylinder{.root = pose->translation(),
                  .axis = pose->linear().col(2),
                  .radius = size.x() / 2,
                  .height = size.z()};
}

float probability_of(const std::vector<double>& probability, objects::ClassId id) {
  return id < probability.size() ? static_cast<float>(probability[id]) : NAN;
}

/// One entry a class; empty where the probability is not known.
std::vector<double> probabilities(float probability, int id, int classes) {
  if (!(probability >= 0 && probability <= 1)) return {};
  const double others = classes > 1 ? (1.0 - probability) / (classes - 1) : 0;
  std::vector<double> result(static_cast<std::size_t>(classes), others);
  result[static_cast<std::size_t>(id)] = probability;
  return result;
}

/// Standard deviations in the object's frame; see objects::Measurement for the order.
void write_deviations(const MapObject& object, map_object_t& message) {
  std::fill_n(message.position_sd, 2, NAN);
  std::fill_n(message.size_sd, 2, NAN);
  const Eigen::VectorXf sd = object.covariance.diagonal().cwiseSqrt().cast<float>();
  if (std::holds_alternative<Cuboid>(object.model) && sd.size() == 9) {
    write_field(sd.segment<2>(3), message.position_sd);
    write_field(sd.segment<2>(6), message.size_sd);
  } else if (std::holds_alternative<Cylinder>(object.model) && sd.size() == 6) {
    write_field(sd.head<2>(), message.position_sd);
    write_field(2 * Eigen::Vector2f(sd(5), sd(5)), message.size_sd);
  }
}

detection_t to_lcm(const Measurement& measurement) {
  detection_t message{};
  message.class_id = static_cast<std::int8_t>(measurement.class_id);
  message.moving = measurement.moving;
  message.probability = probability_of(measurement.class_probability, measurement.class_id);
  message.points = measurement.points;
  write_model(measurement.model, message);
  message.front_log_odds = static_cast<float>(measurement.front_log_odds);
  return message;
}

std::optional<Measurement> measurement_of(const detection_t& message, Time stamp, int classes) {
  const auto model = model_of(message);
  if (!model || message.class_id < 0 || message.class_id >= classes) return std::nullopt;
  return Measurement{
      .stamp = stamp,
      .class_id = static_cast<objects::ClassId>(message.class_id),
      .class_probability = probabilities(message.probability, message.class_id, classes),
      .model = *model,
      .covariance = {},
      .front_log_odds = message.front_log_odds,
      .points = message.points,
      .moving = message.moving != 0};
}

map_object_t gone(int id) {
  map_object_t message{};
  message.id = id;
  message.shape = map_object_t::CUBOID;
  message.orientation[3] = 1;
  return message;
}

/// Place of the object with this id, or of the next one: objects stand in the order of their ids.
std::vector<MapObject>::iterator place_of(objects::ObjectMap& map, int id) {
  return std::lower_bound(map.objects.begin(), map.objects.end(), id,
                          [](const MapObject& object, int value) { return object.id < value; });
}

}  // namespace

map_object_t to_lcm(const MapObject& object) {
  map_object_t message{};
  message.id = object.id;
  message.observations = std::max(1, object.observations);  // 0 says that it is gone
  message.class_id = static_cast<std::int8_t>(object.class_id);
  message.probability = probability_of(object.class_probability, object.class_id);
  write_model(object.model, message);
  write_deviations(object, message);
  return message;
}

std::optional<MapObject> from_lcm(const map_object_t& message, int classes) {
  const auto model = model_of(message);
  if (!model || message.class_id < 0 || message.class_id >= classes) return std::nullopt;
  return MapObject{
      .id = message.id,
      .class_id = static_cast<objects::ClassId>(message.class_id),
      .class_probability = probabilities(message.probability, message.class_id, classes),
      .observations = message.observations,
      .model = *model,
      .covariance = {}};
}

detections_t to_lcm(const Detections& detections) {
  std::vector<const Measurement*> nearest;
  for (const Measurement& measurement : detections.measurements) nearest.push_back(&measurement);
  const std::size_t count = std::min<std::size_t>(nearest.size(), detections_t::MAX_DETECTIONS);
  const auto distance = [](const Measurement* m) { return objects::place(m->model).norm(); };
  std::partial_sort(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(count),
                    nearest.end(),
                    [&](const auto* a, const auto* b) { return distance(a) < distance(b); });
  detections_t message{};
  message.utime = to_utime(detections.stamp);
  message.total = static_cast<std::int32_t>(nearest.size());
  message.num_detections = static_cast<std::int32_t>(count);
  for (std::size_t i = 0; i < count; ++i) message.detections.push_back(to_lcm(*nearest[i]));
  return message;
}

std::optional<Detections> from_lcm(const detections_t& message, int classes) {
  if (message.detections.size() > detections_t::MAX_DETECTIONS) return std::nullopt;
  Detections detections{.stamp = from_utime(message.utime), .measurements = {}, .ground = {}};
  for (const detection_t& entry : message.detections) {
    const auto measurement = measurement_of(entry, detections.stamp, classes);
    if (!measurement) return std::nullopt;
    detections.measurements.push_back(*measurement);
  }
  return detections;
}

object_map_t MapSender::next(const objects::ObjectMap& map, Time now) {
  ++cycle_;
  object_map_t message{};
  message.utime = to_utime(now);
  message.total = static_cast<std::int32_t>(map.objects.size());
  std::map<int, Sent> kept;
  std::vector<const MapObject*> turn;
  for (const MapObject& object : map.objects) {
    turn.push_back(&object);
    const auto before = sent_.find(object.id);
    kept[object.id] = before == sent_.end() ? Sent{} : before->second;
  }
  for (auto& [id, sent] : sent_) {
    if (kept.contains(id) || sent.farewells == kFarewells) continue;
    const bool room = message.objects.size() < object_map_t::MAX_OBJECTS;
    if (room) message.objects.push_back(gone(id));
    kept[id] = {sent.cycle, sent.observations, sent.farewells + (room ? 1 : 0)};
  }
  const auto urgency = [&](const MapObject* object) {
    const Sent& sent = kept[object->id];
    return std::pair(sent.cycle > 0 && sent.observations == object->observations, sent.cycle);
  };
  std::stable_sort(turn.begin(), turn.end(),
                   [&](const auto* a, const auto* b) { return urgency(a) < urgency(b); });
  for (const MapObject* object : turn) {
    if (message.objects.size() == object_map_t::MAX_OBJECTS) break;
    message.objects.push_back(to_lcm(*object));
    kept[object->id] = {cycle_, object->observations, 0};
  }
  message.num_objects = static_cast<std::int32_t>(message.objects.size());
  sent_ = std::move(kept);
  return message;
}

bool merge(const object_map_t& message, int classes, std::size_t most, objects::ObjectMap& map) {
  bool all = true;
  for (const map_object_t& entry : message.objects) {
    const auto at = place_of(map, entry.id);
    const bool known = at != map.objects.end() && at->id == entry.id;
    if (entry.observations <= 0) {
      if (known) map.objects.erase(at);
      continue;
    }
    const auto object = from_lcm(entry, classes);
    if (!object || (!known && map.objects.size() >= most)) {
      all = false;
    } else if (known) {
      *at = *object;
    } else {
      map.objects.insert(at, *object);
    }
  }
  return all;
}

}  // namespace saker::flight
