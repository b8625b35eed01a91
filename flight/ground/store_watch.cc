#include "flight/ground/store_watch.h"

#include <spdlog/spdlog.h>

#include <chrono>
#include <filesystem>

#include "flight/ground/live_source.h"
#include "flight/viewers/schema_parts.h"
#include "saker/core/error.h"

namespace saker::flight::ground {
namespace {

namespace schema = viewers::schema;

constexpr std::chrono::seconds kPeriod{2};

using Bytes = std::map<exchange::StreamId, std::size_t>;

Bytes bytes_of(const StoreReport& report) {
  Bytes bytes;
  for (const StoreReport::Robot& robot : report.robots) {
    for (const StoredStream& stream : robot.streams) bytes[stream.id] = stream.bytes;
  }
  return bytes;
}

Json stream_json(const StoredStream& stream, const std::map<exchange::StreamId, double>& came) {
  const auto kind = static_cast<std::size_t>(stream.id.kind);
  Json json = {{"kind", enum_names(stream.id.kind).at(kind)},
               {"version", stream.id.version},
               {"bytes", stream.bytes},
               {"gaps", stream.gaps}};
  if (const auto at = came.find(stream.id); at != came.end())
    json["came_s"] = viewers::rounded(at->second);
  return json;
}

}  // namespace

void StoreNews::read(double t) {
  StoreReport now = read_report(file_);
  const Bytes before = bytes_of(report_);
  for (const auto& [id, bytes] : bytes_of(now)) {
    const auto at = before.find(id);
    const bool more = at == before.end() || at->second < bytes;
    if (read_before_ && more) came_[id] = t;
  }
  report_ = std::move(now);
  read_before_ = true;
}

std::optional<Json> StoreNews::take(double t) {
  if (!std::filesystem::exists(file_)) return std::nullopt;
  try {
    read(t);
    fault_.clear();
  } catch (const Error& error) {
    if (fault_ != error.what()) spdlog::warn("what the base holds is not shown: {}", error.what());
    fault_ = error.what();
    return std::nullopt;
  }
  Json robots = Json::array();
  for (const StoreReport::Robot& robot : report_.robots) {
    Json json = {{"name", robot.name}, {"streams", Json::array()}};
    if (robot.heard_utime)
      json["heard_s"] = viewers::rounded(static_cast<double>(*robot.heard_utime) * 1e-6);
    for (const StoredStream& stream : robot.streams)
      json["streams"].push_back(stream_json(stream, came_));
    robots.push_back(std::move(json));
  }
  Json json = {{"file_bytes", report_.file_bytes}, {"robots", std::move(robots)}};
  std::string text = json.dump();
  if (text == said_) return std::nullopt;
  said_ = std::move(text);
  return json;
}

const std::string& store_schema() {
  const Json stream = schema::object(
      {{"kind", schema::text("history, prior_map or uncertainty")},
       {"version", schema::integer("of a history: its flight")},
       {"bytes", schema::integer("without a gap")},
       {"gaps", schema::integer("chunks beyond the first gap")},
       {"came_s?", schema::number("s, system clock: more of it came while this was watched")}});
  const Json robot = schema::object({{"name", schema::text()},
                                     {"heard_s?", schema::number("s, the base's system clock")},
                                     {"streams", schema::list(stream)}});
  static const std::string text =
      schema::object({{"file_bytes", schema::integer()}, {"robots", schema::list(robot)}},
                     "saker.Store")
          .dump();
  return text;
}

StoreWatch::StoreWatch(std::string file, Hub& hub)
    : news_(std::move(file)), hub_(hub), thread_([this] { run(); }) {}

StoreWatch::~StoreWatch() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  end_.notify_all();
  thread_.join();
}

/// The channel is there once there is something to say.
void StoreWatch::run() {
  std::optional<std::uint64_t> channel;
  std::unique_lock lock(mutex_);
  while (!ended_) {
    lock.unlock();
    const double t = system_seconds();
    if (const auto news = news_.take(t)) {
      if (!channel) channel = hub_.add_channel("/store", "saker.Store", store_schema(), 1, false);
      hub_.publish(*channel, viewers_time(t), news->dump());
    }
    lock.lock();
    end_.wait_for(lock, kPeriod, [this] { return ended_; });
  }
}

}  // namespace saker::flight::ground
