#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "flight/ground/session.h"

namespace saker::flight::ground {

using Json = nlohmann::ordered_json;

/// What stands between the source of messages and the clients: channels, the last messages of each,
/// sessions, services. Every call may come from any thread.
class Hub {
 public:
  using Steady = Session::Steady;
  using SessionId = std::uint64_t;

  /// Answers a service call once, at once or later, from any thread.
  struct Answer {
    bool done = true;
    std::string text;  ///< JSON of the response, or why not
  };
  using Reply = std::function<void(const Answer&)>;
  /// \param from  address of who asks. Runs in the server's thread; must not wait.
  using Serve = std::function<void(const Json& request, const std::string& from, Reply reply)>;
  using Playback = std::function<void(const PlaybackControl&)>;

  /// Since the start.
  struct Counters {
    long opened = 0, closed = 0;
    long stuck = 0;    ///< cut since they took nothing
    long garbage = 0;  ///< messages that were none; their clients were cut
    long dropped = 0;  ///< messages that clients did not take in time
    long calls = 0;    ///< of services
  };

  explicit Hub(ServerInfo info, const SessionLimits& limits = {});

  // For the source.

  /// \param kept  messages that are kept; 0: none but the newest
  /// \param at_once  all that are kept are sent after a subscription, not the newest alone
  std::uint64_t add_channel(const std::string& topic, const std::string& schema_name,
                            const std::string& schema, int kept, bool at_once);
  void publish(std::uint64_t channel, Time time, std::string json);
  /// Time of a run that is looked at.
  void tell_time(Time time);
  void tell_playback(PlaybackStatus status, Time now, double speed, bool did_seek,
                     const std::string& request);
  /// After a jump in time nothing that was kept holds.
  void forget();
  [[nodiscard]] bool wanted(std::uint64_t channel) const;

  void add_service(const std::string& name, const std::string& request_schema,
                   const std::string& response_schema, Serve serve);
  void on_playback(Playback playback) { playback_ = std::move(playback); }
  /// Called when there is something to send.
  void on_output(std::function<void()> wake) { wake_ = std::move(wake); }

  // For the server.

  [[nodiscard]] SessionId open(const std::string& from, bool sdk, Steady::time_point now);
  void close(SessionId session);
  /// False where the client is to be cut: what it sends is garbage, or it asks and does not take
  /// the answers, each of which may have megabytes.
  [[nodiscard]] bool hear(SessionId session, std::span<const std::uint8_t> bytes, bool binary,
                          Steady::time_point now);
  [[nodiscard]] std::optional<Session::Outgoing> take(SessionId session, Steady::time_point now);
  [[nodiscard]] std::vector<SessionId> with_output() const;
  /// Those to be cut; the others that are slow are told so. To be called once a second.
  [[nodiscard]] std::vector<SessionId> stuck(Steady::time_point now);

  [[nodiscard]] std::size_t sessions() const;
  [[nodiscard]] Counters counters() const;

 private:
  struct Kept {
    Time time;
    Text json;
  };
  struct ChannelState {
    Channel channel;
    std::size_t kept = 0;
    bool at_once = false;
    int wanted = 0;  // by so many sessions
    std::size_t bytes = 0;
    std::deque<Kept> messages;
  };
  struct ServiceState {
    Service service;
    Serve serve;
  };
  static constexpr std::size_t kMostKeptBytes = std::size_t{4} << 20;  // of a channel

  [[nodiscard]] bool has_room(SessionId id);
  void count_stuck(SessionId id);
  void greet(Session& session, Steady::time_point now);
  void take(Session& session, const Subscribe& message, Steady::time_point now);
  void take(Session& session, const Unsubscribe& message);
  void call(SessionId id, const ServiceCall& message);
  void reply(SessionId id, const ServiceCall& message, const Answer& answer);
  void serve_history(const Json& request, const Reply& reply) const;
  /// The kept messages of the last seconds, as the elements of a list; nothing: no such topic.
  [[nodiscard]] std::optional<std::string> history(const std::string& topic, double seconds) const;
  void wake() const;

  ServerInfo info_;
  SessionLimits limits_;
  mutable std::mutex mutex_;
  std::map<std::uint64_t, ChannelState> channels_;
  std::vector<ServiceState> services_;  // not changed once clients come
  std::map<SessionId, Session> sessions_;
  SessionId last_session_ = 0;
  Counters counters_;
  std::set<SessionId> stuck_;  // counted; not closed yet
  std::optional<Time> time_;
  Playback playback_;
  std::function<void()> wake_;
};

}  // namespace saker::flight::ground
