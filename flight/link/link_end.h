#pragma once

#include <array>
#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "flight/bus/bus.h"
#include "flight/link/config.h"
#include "flight/link/fragments.h"
#include "flight/link/outbox.h"
#include "flight/link/session.h"
#include "flight/link/udp_socket.h"
#include "saker/exchange/key.h"
#include "saker/exchange/seal.h"

namespace saker::flight {

/// One end of the sealed link between a robot's LCM and the ground's: the robot's end has the
/// ground as its only counterpart, the ground's end every robot that calls.
///
/// Every datagram is sealed with the robot's key, both ways, for the channel R1_LINK. Rights: the
/// ground's end takes `config.up`, as channels of the robot whose key sealed it and of no other;
/// the robot's end takes `config.down`, for itself, from the ground's address. What an end does not
/// take is counted. While nobody is there, nothing is sent but a robot's calls (5 Hz); of each
/// channel the newest message is kept, of events (keep above 1) none. One thread, no sockets.
class LinkEnd {
 public:
  using Steady = std::chrono::steady_clock;
  enum class End { robot, ground };
  /// False where the datagram cannot be sent.
  using Send = std::function<bool(const Address& to, std::string_view datagram)>;

  /// Datagrams and messages that an end does not take.
  struct Refused {
    long unsealed = 0;   ///< forged, cut, of another version, its own
    long replayed = 0;   ///< genuine, but taken before
    long asking = 0;     ///< genuine, of a life that has yet to answer a challenge, or a recording
    long second = 0;     ///< of another robot of the same name, while the first one is heard
    long strangers = 0;  ///< to a robot, not from the ground's address
    long without_right = 0;  ///< of a channel that does not pass in this direction, or no message
    long crowded = 0;        ///< of more robots than the ceiling

    [[nodiscard]] long all() const {
      return unsealed + replayed + asking + second + strangers + without_right + crowded;
    }
  };
  struct Counters {
    long in_messages = 0, in_bytes = 0;    ///< published on this LCM
    long out_messages = 0, out_bytes = 0;  ///< sent to the counterparts
    long replaced = 0;                     ///< by newer ones before they were due
    long nobody = 0;                       ///< not sent: their counterpart is not there
    long echoes = 0;  ///< heard on this LCM, but said there by this end, or carried back
    long oversized = 0;
    long not_sent = 0;    ///< datagrams that the network did not take
    long incomplete = 0;  ///< messages of which a piece was lost
    Refused refused;
  };
  struct Report {
    int connected = 0;  ///< counterparts that are there
    Counters counters{};
  };

  /// Subscribes to `bus`, this machine's LCM, which has to outlive this.
  /// \param most_robots  of the ground's end
  /// Throws Error on a wrong value, where a channel must not pass, or for another robot's key.
  LinkEnd(const LinkConfig& config, End end, const exchange::Key& key, Bus& bus, int most_robots,
          Send send);

  void receive(Steady::time_point now, const Address& from, std::string_view datagram);

  /// Sends what is due.
  void step(Steady::time_point now);

  /// To each counterpart that is there, before this process ends: its next life is taken at once.
  void say_goodbye();

  /// Until when there is nothing to send, unless something is heard.
  [[nodiscard]] Steady::time_point next_due() const;

  /// How many counterparts are there.
  [[nodiscard]] int connected() const;
  [[nodiscard]] Counters counters() const;
  [[nodiscard]] Report report() const { return {connected(), counters()}; }

 private:
  struct Said {
    std::uint64_t hash = 0;
    Steady::time_point when;
  };

  /// Of one life at one address that was answered: its newest datagram, and when.
  struct Answered {
    std::uint64_t counter = 0;
    Steady::time_point when{};
  };

  /// Of a robot: its counterpart here.
  struct Counterpart {
    Address address;
    Session session;
    Outbox outbox;
    std::map<std::string, FragmentJoiner> joiners{};                   // by channel
    std::map<std::string, std::deque<Said>> said{};                    // and heard here, by channel
    std::map<std::pair<Address, std::uint64_t>, Answered> answered{};  // by address and epoch
    Steady::time_point next_call{}, next_warning{}, seen{}, second_since{}, second_seen{};
    bool there = false;
  };

  bool hear(const std::string& channel, const LinkedChannel& linked, Bus::Bytes bytes);
  [[nodiscard]] Counterpart* counterpart_of(const std::string& robot, const Address& from);
  void answer(const std::string& robot, Counterpart& counterpart, const Address& to,
              const exchange::Opened& message);
  void warn_of_second(const std::string& robot, Counterpart& counterpart, const Address& from);
  void deliver(const std::string& robot, Counterpart& counterpart, std::string_view body);
  void send(const std::string& robot, const Address& to, const std::string& payload);
  void lose(const std::string& robot, Counterpart& counterpart, const char* why);
  void look_after(const std::string& robot, Counterpart& counterpart);
  [[nodiscard]] bool is_new(Counterpart& counterpart, const std::string& channel, Bus::Bytes bytes);

  LinkConfig config_;
  End end_;
  exchange::Key key_;
  Bus& bus_;
  std::size_t most_robots_;
  Send send_;
  exchange::Sealer sealer_;
  std::map<std::string, bool> takes_;  // channel → whether each message counts, not the newest only
  std::vector<LinkedChannel> gives_;
  std::map<std::string, Counterpart> counterparts_;  // by robot
  Steady::time_point now_{};                         // of the last step or datagram
  Counters counters_;  // without those of outboxes and joiners that are there
};

/// What HEALTH shows of it: name (at most 24 bytes) and value.
[[nodiscard]] std::vector<std::pair<std::string, long>> health(const LinkEnd::Report& report);

}  // namespace saker::flight
