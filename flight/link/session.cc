#include "flight/link/session.h"

#include <sodium.h>

#include "saker/exchange/bytes.h"

namespace saker::flight {
namespace {

constexpr std::string_view kGoodbye = "\xff";  // no fragment begins so (fragments.h)
constexpr double kLate_s = 0.1;                // of a hello, by who sends it and by the radio

Session::Steady::duration seconds(double seconds) {
  return std::chrono::duration_cast<Session::Steady::duration>(
      std::chrono::duration<double>(seconds));
}

std::string with_challenges(std::uint64_t own, std::uint64_t echo, std::string_view body) {
  exchange::ByteWriter out;
  out.fixed(own);
  out.fixed(echo);
  out.raw(body);
  return out.bytes();
}

}  // namespace

Session::Session(double lost_s, double hello_s)
    : lost_(seconds(lost_s)), silent_(seconds(hello_s + kLate_s)) {
  draw_challenge();
}

void Session::draw_challenge() { randombytes_buf(&challenge_, sizeof challenge_); }

void Session::end() {
  epoch_.reset();
  draw_challenge();
}

/// Of the life that brought a challenge while another one was heard.
bool Session::is_next(Steady::time_point now, const exchange::Opened& message) const {
  return next_ && next_->epoch == message.epoch && message.counter > next_->counter &&
         now - next_->heard < lost_;
}

Session::Heard Session::open(Steady::time_point now, const exchange::Opened& message) {
  exchange::ByteReader in(message.payload);
  const auto theirs = in.fixed<std::uint64_t>(), brought = in.fixed<std::uint64_t>();
  if (in.failed()) return {};
  if (epoch_ && !alive(now)) end();
  const bool begins = epoch_ != message.epoch;
  if (begins) {
    const bool proven = is_next(now, message);
    if (brought == challenge_) {
      draw_challenge();
    } else if (!proven) {
      return {Outcome::asks};
    }
    if (epoch_ && now - heard_ < silent_) {
      next_ = {message.epoch, message.counter, now};
      return {Outcome::second};
    }
    next_.reset();
    epoch_ = message.epoch;
    // What it said before was said to an earlier life of this end, or before a silence.
    window_ = {message.counter, exchange::ReplayWindow::Taken().set()};
  } else if (!window_.take(message.counter)) {
    return {Outcome::replayed};
  }
  echo_ = theirs;
  heard_ = now;
  newest_ = message.counter == window_.newest();
  if (std::string_view(message.payload).substr(in.at()) == kGoodbye) {
    end();
    return {Outcome::goodbye};
  }
  return {begins ? Outcome::begun : Outcome::taken, message.payload.substr(in.at())};
}

std::string Session::payload(std::string_view body) const {
  return with_challenges(challenge_, echo_, body);
}

std::string Session::goodbye() const { return payload(kGoodbye); }

std::string Session::answer(const exchange::Opened& message) const {
  exchange::ByteReader in(message.payload);
  return with_challenges(challenge_, in.fixed<std::uint64_t>(), "");
}

}  // namespace saker::flight
