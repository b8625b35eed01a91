#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "saker/exchange/peer.h"
#include "saker/exchange/seal.h"
#include "saker/exchange/store.h"

/// Stage: what robots tell each other. Reads and makes sealed datagrams of at most
/// kLongestDatagram bytes (for the channel _EXCHANGE, which may lose, repeat and reorder them) and
/// a Store of streams; makes the stores at both ends of a link equal.
///
/// Order of reading: stream.h (what a stream is), store.h, peer.h (the protocol), seal.h (the
/// team's key), packed_history.h (a flight in bytes). Nothing here opens a socket; the clock is
/// read once, when a sealer begins its epoch.
namespace saker::exchange {

/// Of a datagram as it goes into exchange_t.
constexpr std::size_t kLongestDatagram = 1232;
static_assert(kLongestMessage + kSealBytes <= kLongestDatagram);

/// A sealed datagram and where it goes.
struct Datagram {
  std::string channel;
  std::string bytes;
};

/// All links of one process: a robot has one, to the base; the base has one to each robot.
class Exchange {
 public:
  struct Counters {
    long sent_bytes = 0, sent_datagrams = 0;
    long received_bytes = 0, received_datagrams = 0;  ///< whatever they are worth
    long unsealed = 0;                                ///< not sent: this is another robot's key
    long strangers = 0;    ///< genuine, but of another than the link's counterpart
    Peer::Counters peers;  ///< of all links
  };

  /// How a link stands.
  struct Contact {
    std::string channel;
    std::string counterpart;  ///< empty before any was heard
    std::optional<Time> heard;
    bool in_contact = false;
    bool all_sent = false;   ///< the counterpart holds all that we do
    bool all_heard = false;  ///< we hold all that the counterpart said it holds
  };

  /// \param name  under which this process seals: R1, BASE
  /// \param folder  where the seal's counters are kept; made when it is not there
  /// \param store  has to outlive this
  /// Throws Error on an invalid configuration, a name that is none, another robot's key, a folder
  /// that cannot be written.
  Exchange(const PeerConfig& config, const std::string& name, const Key& key,
           const std::filesystem::path& folder, Store& store);

  /// Links that are not listed do not exist: what comes for another channel is a stranger's.
  void add_link(const std::string& channel, Role role);

  /// Never throws. The verdict is also counted.
  Verdict receive(Time now, const std::string& channel, std::string_view sealed);

  /// The next datagram that is due on any link; call until there is none, at 50 Hz or more.
  [[nodiscard]] std::optional<Datagram> next(Time now);

  /// For a robot's first message, before it has a link.
  [[nodiscard]] Opener& opener() { return opener_; }
  [[nodiscard]] const Opener& opener() const { return opener_; }

  [[nodiscard]] Counters counters() const;
  [[nodiscard]] std::vector<Contact> contacts(Time now) const;

 private:
  struct Link {
    std::string counterpart;
    Peer peer;
  };

  PeerConfig config_;
  Store& store_;
  Sealer sealer_;
  Opener opener_;
  std::map<std::string, Link> links_;  // by channel
  Counters counters_;
};

/// Every figure that HEALTH shows: name (at most 24 bytes) and value.
[[nodiscard]] std::vector<std::pair<std::string, long>> health(const Exchange& exchange);

}  // namespace saker::exchange
