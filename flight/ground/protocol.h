#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "saker/core/time.h"

/// The Foxglove WebSocket protocol, version 1 (foxglove.websocket.v1; foxglove.sdk.v1 has the same
/// bytes and playback control besides): what clients send, what a server says. Pure functions.
namespace saker::flight::ground {

inline constexpr const char* kSubprotocols[] = {"foxglove.websocket.v1", "foxglove.sdk.v1"};

// What a client sends.

struct Subscription {
  std::uint32_t id = 0;  ///< the client's own
  std::uint64_t channel = 0;
};
struct Subscribe {
  std::vector<Subscription> subscriptions;
};
struct Unsubscribe {
  std::vector<std::uint32_t> ids;
};
struct ServiceCall {
  std::uint32_t service = 0, call = 0;
  std::string encoding, payload;
};
struct PlaybackControl {
  bool playing = false;
  double speed = 1;
  std::optional<Time> seek;
  std::string request;
};
/// Something of the protocol that this server does not offer.
struct NotOffered {
  std::string what;
};
/// Not of the protocol at all.
struct Garbage {
  std::string why;
};
using ClientMessage =
    std::variant<Subscribe, Unsubscribe, ServiceCall, PlaybackControl, NotOffered, Garbage>;

inline constexpr std::size_t kMostClientBytes = 65536;  ///< of one message
inline constexpr std::size_t kMostRequestBytes = 256;   ///< of playback's id: it is said to all

/// Never throws; whatever the bytes are.
[[nodiscard]] ClientMessage parse_client_message(std::span<const std::uint8_t> bytes, bool binary);

// What a server says.

struct Channel {
  std::uint64_t id = 0;
  std::string topic, schema_name, schema;
};
struct Service {
  std::uint32_t id = 0;
  std::string name;
  std::string request, response;  ///< JSON schemas
};
struct ServerInfo {
  std::string mode;                ///< "live" or "run"
  std::string version;             ///< of the program
  std::string session;             ///< another one each start
  std::optional<Time> begin, end;  ///< of a run
};

[[nodiscard]] std::string server_info(const ServerInfo& info);
[[nodiscard]] std::string advertise(const std::vector<Channel>& channels);
[[nodiscard]] std::string advertise_services(const std::vector<Service>& services);
/// \param level  0 info, 1 warning, 2 error
[[nodiscard]] std::string status(int level, const std::string& text, const std::string& id = "");
[[nodiscard]] std::string service_failure(std::uint32_t service, std::uint32_t call,
                                          const std::string& text);

inline constexpr std::size_t kMessageHead = 13;
/// What stands before the payload of a message.
[[nodiscard]] std::string message_head(std::uint32_t subscription, Time time);
[[nodiscard]] std::string time_message(Time time);
[[nodiscard]] std::string service_response(std::uint32_t service, std::uint32_t call,
                                           std::string_view json);
enum class PlaybackStatus { playing = 0, paused = 1, buffering = 2, ended = 3 };
[[nodiscard]] std::string playback_state(PlaybackStatus status, Time now, double speed,
                                         bool did_seek, const std::string& request);

}  // namespace saker::flight::ground
