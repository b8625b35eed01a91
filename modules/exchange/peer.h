#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "saker/core/config.h"
#include "saker/core/time.h"
#include "saker/exchange/digest.h"
#include "saker/exchange/message.h"
#include "saker/exchange/store.h"

namespace saker::exchange {

struct PeerConfig {
  double rate_kb_s = 100;
  double budget_kb = 20000;
  int round_chunks = 64;
  double answer_delay_s = 0.02;
  double retry_s = 0.3;
  double most_retry_s = 2;
  double hello_s = 1;
  double contact_lost_s = 10;
  double refused_again_s = 30;

  template <class Visitor>
  void visit(Visitor& v) {
    v.setting("rate_kb_s", rate_kb_s, {1, 1e5}, "kB/s",
              "Nobody is sent more a second; 100 are a tenth of a slow Wi-Fi link.");
    v.setting("budget_kb", budget_kb, {1, 1e9}, "kB",
              "Nobody is sent more while in reach; a flight is 0.2 MB.");
    v.field("round_chunks", round_chunks, {1, 256}, "",
            "chunks sent before an acknowledgement is awaited: one costs a twentieth of a chunk");
    v.field("answer_delay_s", answer_delay_s, {0, 0.5}, "s",
            "from the last chunk to its acknowledgement: what comes in another order comes within; "
            "doubles when a chunk comes twice");
    v.field("retry_s", retry_s, {0.01, 10}, "s",
            "until an acknowledgement is asked for again, before any was timed");
    v.field("most_retry_s", most_retry_s, {0.01, 60}, "s", "the same after many in vain");
    v.field("hello_s", hello_s, {0.1, 60}, "s",
            "between calls of a robot that hears nobody, or has nothing to say");
    v.field("contact_lost_s", contact_lost_s, {1, 600}, "s",
            "of silence that end a contact and its budget");
    v.field("refused_again_s", refused_again_s, {1, 3600}, "s",
            "until a stream is offered again that the counterpart could not keep");
  }
};

/// Who calls first: a robot does, the base answers.
enum class Role { calls, answers };

/// One end of the link between a robot and the base station: makes both stores hold the same
/// bytes. Both ends are the same but for who calls first.
///
/// Messages in and out are plain bytes of at most kLongestMessage, `now` is given: no sockets, no
/// clock. Rounds: up to `round_chunks` chunks of one stream that the counterpart lacks, then a
/// question for its holdings (the answer is the acknowledgement); only what the answer to this
/// round lacks is sent again. An answer that does not come is asked for again, not the chunks. All
/// that has to survive an end's death is in its store. Source: selective repeat with polling as in
/// LTE's radio link control (3GPP TS 36.322, section 5.2); the time-out is RFC 6298's.
class Peer {
 public:
  struct Counters {
    long chunks_sent = 0;
    long chunks_received = 0;  ///< that were new
    long chunks_repeated = 0;  ///< received, but held already
    long malformed = 0;        ///< messages that cannot be read
    long conflicts = 0;        ///< streams that differ where both ends hold them: not exchanged
    long refused = 0;          ///< chunks that the store did not take
  };

  Peer(const PeerConfig& config, Role role, Store& store);

  /// A message of the counterpart, opened.
  void receive(Time now, std::string_view message);

  /// The next message to the counterpart that is due; call until there is none, at 50 Hz or more.
  /// \param framing  bytes by which it grows on its way, counted against rate and budget
  [[nodiscard]] std::optional<std::string> next(Time now, std::size_t framing);

  [[nodiscard]] bool in_contact(Time now) const;
  /// Nothing left that the counterpart lacks, as far as it said.
  [[nodiscard]] bool all_sent() const;
  /// Nothing left that the counterpart holds and we lack, as far as it said.
  [[nodiscard]] bool all_heard() const;
  /// When the counterpart was heard last; nothing before.
  [[nodiscard]] std::optional<Time> heard() const { return heard_; }
  [[nodiscard]] const Counters& counters() const { return counters_; }

 private:
  /// What is known of the counterpart's copy of a stream.
  struct Remote {
    Extent held;
    PrefixDigest digest;       // of the own copy, as far as the counterpart's
    std::size_t compared = 0;  // bytes whose digests were compared
    Time refused_until = 0;
    bool conflict = false;
  };

  /// What was asked and is not answered yet.
  struct Round {
    std::uint32_t number = 0;
    std::set<StreamId> streams{};        // whose holdings are awaited
    std::vector<ChunkMessage> chunks{};  // in reverse: still to be sent
    Time asked = 0;
    int asked_times = 0;
  };

  // The counterpart's side of things.
  void begin_contact();
  void take(Time now, const HoldingsMessage& holdings);
  void take(Time now, const ChunkMessage& chunk);
  void learn(Time now, const Holding& line);
  void answer_later(Time now, std::uint32_t round);

  // Our side.
  [[nodiscard]] std::optional<std::string> due(Time now);
  [[nodiscard]] std::optional<std::string> due_answer(Time now);
  [[nodiscard]] std::optional<std::string> due_in_round(Time now);
  [[nodiscard]] std::optional<std::string> due_call(Time now);
  [[nodiscard]] bool begin_round(Time now);
  [[nodiscard]] bool ask_unknown();
  [[nodiscard]] bool send_missing(Time now);
  [[nodiscard]] std::vector<ChunkMessage> missing(const StreamId& id, const Extent& held) const;
  [[nodiscard]] std::string ask(Time now);
  [[nodiscard]] Holding holding(const StreamId& id);
  /// As many of them as fit into a message.
  [[nodiscard]] std::vector<Holding> holdings(const std::set<StreamId>& ids);
  void close_round(Time now);
  [[nodiscard]] Time timeout() const;
  [[nodiscard]] bool wanted(Time now, const StreamId& id, const Extent& own) const;

  PeerConfig config_;
  Role role_;
  Store& store_;
  Counters counters_;

  std::map<StreamId, Remote> remotes_;        // of streams whose holdings were said in this contact
  std::map<StreamId, PrefixDigest> digests_;  // of the own copies
  std::optional<Time> heard_;
  std::optional<Time> called_;

  std::optional<Round> round_;
  std::uint32_t rounds_ = 0;
  double round_trip_s_ = NAN, round_trip_deviation_s_ = NAN;

  std::set<StreamId> to_answer_, unkept_;  // holdings that were asked for; what the store refused
  bool answer_pending_ = false;
  std::uint32_t answered_round_ = 0;
  Time answer_due_ = 0;
  Time answer_delay_;

  double tokens_ = 0;  // bytes
  Time tokens_at_ = 0;
  double spent_ = 0;  // bytes in this contact
};

}  // namespace saker::exchange
