#include "flight/ground/protocol.h"

#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

namespace saker::flight::ground {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostSubscriptions = 4096;  // in one message

/// Reads little-endian numbers; what is missing makes it fail.
class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  template <class Number>
  Number take() {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < sizeof(Number); ++i) {
      if (bytes_.empty()) {
        failed_ = true;
        return 0;
      }
      value |= static_cast<std::uint64_t>(bytes_.front()) << (8 * i);
      bytes_ = bytes_.subspan(1);
    }
    return static_cast<Number>(value);
  }
  std::string take_text(std::size_t size) {
    if (size > bytes_.size()) {
      failed_ = true;
      return {};
    }
    const std::string text(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(size));
    bytes_ = bytes_.subspan(size);
    return text;
  }
  std::string take_rest() { return take_text(bytes_.size()); }
  [[nodiscard]] bool failed() const { return failed_; }

 private:
  std::span<const std::uint8_t> bytes_;
  bool failed_ = false;
};

template <class Number>
void add(std::string& bytes, Number value) {
  for (std::size_t i = 0; i < sizeof(Number); ++i)
    bytes += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i) & 0xff);
}

template <class Number>
std::optional<Number> whole(const Json& object, const char* key, std::uint64_t most) {
  const auto at = object.find(key);
  if (at == object.end() || !at->is_number_unsigned()) return std::nullopt;
  const auto value = at->get<std::uint64_t>();
  return value <= most ? std::optional(static_cast<Number>(value)) : std::nullopt;
}

ClientMessage subscribe(const Json& message) {
  const auto list = message.find("subscriptions");
  if (list == message.end() || !list->is_array() || list->size() > kMostSubscriptions)
    return Garbage{"subscribe without subscriptions"};
  Subscribe result;
  for (const Json& entry : *list) {
    if (!entry.is_object()) return Garbage{"a subscription that is no object"};
    const auto id = whole<std::uint32_t>(entry, "id", UINT32_MAX);
    const auto channel = whole<std::uint64_t>(entry, "channelId", UINT64_MAX);
    if (!id || !channel) return Garbage{"a subscription without id and channelId"};
    result.subscriptions.push_back({*id, *channel});
  }
  return result;
}

ClientMessage unsubscribe(const Json& message) {
  const auto list = message.find("subscriptionIds");
  if (list == message.end() || !list->is_array() || list->size() > kMostSubscriptions)
    return Garbage{"unsubscribe without subscriptionIds"};
  Unsubscribe result;
  for (const Json& entry : *list) {
    if (!entry.is_number_unsigned() || entry.get<std::uint64_t>() > UINT32_MAX)
      return Garbage{"a subscription id that is no number"};
    result.ids.push_back(entry.get<std::uint32_t>());
  }
  return result;
}

ClientMessage parse_text(std::span<const std::uint8_t> bytes) {
  static const std::set<std::string> others = {"advertise",
                                               "unadvertise",
                                               "getParameters",
                                               "setParameters",
                                               "fetchAsset",
                                               "subscribeParameterUpdates",
                                               "unsubscribeParameterUpdates",
                                               "subscribeConnectionGraph",
                                               "unsubscribeConnectionGraph"};
  const Json message = Json::parse(bytes.begin(), bytes.end(), nullptr, false);
  if (!message.is_object()) return Garbage{"no JSON object"};
  const auto op = message.find("op");
  if (op == message.end() || !op->is_string()) return Garbage{"no op"};
  const auto word = op->get<std::string>();
  if (word == "subscribe") return subscribe(message);
  if (word == "unsubscribe") return unsubscribe(message);
  if (others.contains(word)) return NotOffered{word};
  return Garbage{"an unknown op"};
}

ClientMessage service_call(Reader& reader) {
  ServiceCall call;
  call.service = reader.take<std::uint32_t>();
  call.call = reader.take<std::uint32_t>();
  call.encoding = reader.take_text(reader.take<std::uint32_t>());
  call.payload = reader.take_rest();
  if (reader.failed()) return Garbage{"a service call that is cut"};
  return call;
}

ClientMessage playback_control(Reader& reader) {
  const auto command = reader.take<std::uint8_t>();
  const auto speed = std::bit_cast<float>(reader.take<std::uint32_t>());
  const bool seeks = reader.take<std::uint8_t>() != 0;
  const auto seek = reader.take<std::uint64_t>();
  std::string request = reader.take_text(reader.take<std::uint32_t>());
  const bool fine = !reader.failed() && command <= 1 && std::isfinite(speed) && seek <= INT64_MAX &&
                    request.size() <= kMostRequestBytes;
  if (!fine) return Garbage{"playback control that is cut or wrong"};
  PlaybackControl control{.playing = command == 0,
                          .speed = static_cast<double>(speed),
                          .seek = std::nullopt,
                          .request = std::move(request)};
  if (seeks) control.seek = static_cast<Time>(seek);
  return control;
}

ClientMessage parse_binary(std::span<const std::uint8_t> bytes) {
  enum { kMessageData = 1, kServiceCall = 2, kPlaybackControl = 3 };
  Reader reader(bytes);
  switch (reader.take<std::uint8_t>()) {
    case kMessageData:
      return NotOffered{"messages of clients"};
    case kServiceCall:
      return service_call(reader);
    case kPlaybackControl:
      return playback_control(reader);
    default:
      return Garbage{"an unknown binary message"};
  }
}

Json time_json(Time time) {
  return {{"sec", time / kNanosecondsPerSecond}, {"nsec", time % kNanosecondsPerSecond}};
}

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

ClientMessage parse_client_message(std::span<const std::uint8_t> bytes, bool binary) {
  if (bytes.empty()) return Garbage{"an empty message"};
  if (bytes.size() > kMostClientBytes) return Garbage{"a message that is too long"};
  return binary ? parse_binary(bytes) : parse_text(bytes);
}

std::string server_info(const ServerInfo& info) {
  Json capabilities = {"services"};
  if (info.begin) {
    capabilities.push_back("time");
    capabilities.push_back("playbackControl");
  }
  Json json = {{"op", "serverInfo"},
               {"name", "saker-ground"},
               {"capabilities", capabilities},
               {"supportedEncodings", Json::array({"json"})},
               {"metadata", {{"mode", info.mode}, {"version", info.version}}},
               {"sessionId", info.session}};
  if (info.begin) json["dataStartTime"] = time_json(*info.begin);
  if (info.end) json["dataEndTime"] = time_json(*info.end);
  return text_of(json);
}

std::string advertise(const std::vector<Channel>& channels) {
  Json list = Json::array();
  for (const Channel& channel : channels) {
    list.push_back({{"id", channel.id},
                    {"topic", channel.topic},
                    {"encoding", "json"},
                    {"schemaName", channel.schema_name},
                    {"schemaEncoding", "jsonschema"},
                    {"schema", channel.schema}});
  }
  return text_of({{"op", "advertise"}, {"channels", std::move(list)}});
}

std::string advertise_services(const std::vector<Service>& services) {
  Json list = Json::array();
  const auto side = [](const std::string& name, const std::string& schema) -> Json {
    return {{"encoding", "json"},
            {"schemaName", name},
            {"schemaEncoding", "jsonschema"},
            {"schema", schema}};
  };
  for (const Service& service : services) {
    list.push_back({{"id", service.id},
                    {"name", service.name},
                    {"type", "saker." + service.name},
                    {"request", side("saker." + service.name + ".Request", service.request)},
                    {"response", side("saker." + service.name + ".Response", service.response)}});
  }
  return text_of({{"op", "advertiseServices"}, {"services", std::move(list)}});
}

std::string status(int level, const std::string& text, const std::string& id) {
  Json json = {{"op", "status"}, {"level", level}, {"message", text}};
  if (!id.empty()) json["id"] = id;
  return text_of(json);
}

std::string service_failure(std::uint32_t service, std::uint32_t call, const std::string& text) {
  return text_of(
      {{"op", "serviceCallFailure"}, {"serviceId", service}, {"callId", call}, {"message", text}});
}

std::string message_head(std::uint32_t subscription, Time time) {
  std::string bytes(1, '\1');
  add(bytes, subscription);
  add(bytes, static_cast<std::uint64_t>(time));
  return bytes;
}

std::string time_message(Time time) {
  std::string bytes(1, '\2');
  add(bytes, static_cast<std::uint64_t>(time));
  return bytes;
}

std::string service_response(std::uint32_t service, std::uint32_t call, std::string_view json) {
  std::string bytes(1, '\3');
  add(bytes, service);
  add(bytes, call);
  add(bytes, std::uint32_t{4});
  bytes += "json";
  bytes += json;
  return bytes;
}

std::string playback_state(PlaybackStatus status, Time now, double speed, bool did_seek,
                           const std::string& request) {
  std::string bytes(1, '\5');
  add(bytes, static_cast<std::uint8_t>(status));
  add(bytes, static_cast<std::uint64_t>(now));
  add(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(speed)));
  add(bytes, static_cast<std::uint8_t>(did_seek ? 1 : 0));
  add(bytes, static_cast<std::uint32_t>(request.size()));
  return bytes + request;
}

}  // namespace saker::flight::ground
