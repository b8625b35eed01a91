#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "saker/exchange/replay_window.h"
#include "saker/exchange/seal.h"

namespace saker::flight {

/// What one end of the link knows of its counterpart: whether it lives now, and what of it was
/// heard. Needs no file and no clock that is right.
///
/// Every datagram carries a challenge of its sender, and back the last one that was heard of the
/// receiver. A life (epoch) of the counterpart begins with a datagram that brings the challenge
/// which is open here: only who has the key and lives now can seal it. Then the challenge is drawn
/// anew, so no recording brings it, whichever end was started again, and whatever was lost. Within
/// a life a window takes each counter once, and none from before its first datagram. While one life
/// is heard no other begins: of two robots of one name the first one keeps the link. A life that
/// said goodbye is over, and one that let a hello of its own pass gives way to the next.
class Session {
 public:
  using Steady = std::chrono::steady_clock;

  enum class Outcome {
    taken,
    begun,     ///< taken, the first of a life
    asks,      ///< of a life that did not bring the challenge: to be answered
    second,    ///< it lives, but so does another of its name, or did a moment ago
    goodbye,   ///< taken, the last of its life
    replayed,  ///< taken before, or too old to know
    malformed
  };
  struct Heard {
    Outcome outcome = Outcome::malformed;
    std::string body{};  ///< of one that was taken
  };

  /// \param lost_s  of silence after which the counterpart is gone
  /// \param hello_s  of silence after which another life of it that calls is taken in its place
  Session(double lost_s, double hello_s);

  /// \param message  genuine (exchange::unsealed)
  [[nodiscard]] Heard open(Steady::time_point now, const exchange::Opened& message);

  /// What is to be sealed and sent: both challenges, then the body.
  [[nodiscard]] std::string payload(std::string_view body) const;
  /// The same for who asks, in answer to its message.
  [[nodiscard]] std::string answer(const exchange::Opened& message) const;
  /// To be sealed and sent where this end stops: the counterpart waits for no silence.
  [[nodiscard]] std::string goodbye() const;

  /// The life that was heard is over: what answers an earlier call, or was held back, begins none.
  void end();

  [[nodiscard]] bool alive(Steady::time_point now) const { return epoch_ && now - heard_ < lost_; }
  /// The last datagram that was taken is the newest of its life.
  [[nodiscard]] bool newest() const { return newest_; }
  /// When it was heard last.
  [[nodiscard]] Steady::time_point heard() const { return heard_; }

 private:
  /// A life that is to follow the one that is heard.
  struct Next {
    std::uint64_t epoch = 0, counter = 0;
    Steady::time_point heard{};
  };

  void draw_challenge();
  [[nodiscard]] bool is_next(Steady::time_point now, const exchange::Opened& message) const;

  Steady::duration lost_, silent_;
  std::optional<std::uint64_t> epoch_;  // of the life that is heard
  std::optional<Next> next_;
  exchange::ReplayWindow window_;
  std::uint64_t challenge_ = 0;  // open here
  std::uint64_t echo_ = 0;       // the counterpart's, as it was heard last
  Steady::time_point heard_{};
  bool newest_ = false;
};

}  // namespace saker::flight
