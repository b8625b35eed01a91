#include "flight/link/session.h"

#include <sodium.h>

#include "saker/exchange/bytes.h"

namespace saker::flight {
namespace {

std::string with_challenges(std::uint64_t own, std::uint64_t echo, std::string_view body) {
  exchange::ByteWriter out;
  out.fixed(own);
  out.fixed(echo);
  out.raw(body);
  return out.bytes();
}

}  // namespace

Session::Session(double lost_s)
    : lost_(std::chrono::duration_cast<Steady::duration>(std::chrono::duration<double>(lost_s))) {
  draw_challenge();
}

void Session::draw_challenge() { randombytes_buf(&challenge_, sizeof challenge_); }

Session::Heard Session::open(Steady::time_point now, const exchange::Opened& message) {
  exchange::ByteReader in(message.payload);
  const auto theirs = in.fixed<std::uint64_t>(), brought = in.fixed<std::uint64_t>();
  if (in.failed()) return {};
  if (epoch_ && !alive(now)) {  // what was held back meanwhile does not come after all
    epoch_.reset();
    draw_challenge();
  }
  const bool begins = epoch_ != message.epoch;
  if (begins) {
    if (brought != challenge_) return {Outcome::asks};
    draw_challenge();
    if (epoch_) return {Outcome::second};
    epoch_ = message.epoch;
    // What it said before was said to an earlier life of this end, or before a silence.
    window_ = {message.counter, exchange::ReplayWindow::Taken().set()};
  } else if (!window_.take(message.counter)) {
    return {Outcome::replayed};
  }
  echo_ = theirs;
  heard_ = now;
  newest_ = message.counter == window_.newest();
  return {begins ? Outcome::begun : Outcome::taken, message.payload.substr(in.at())};
}

std::string Session::payload(std::string_view body) const {
  return with_challenges(challenge_, echo_, body);
}

std::string Session::answer(const exchange::Opened& message) const {
  exchange::ByteReader in(message.payload);
  return with_challenges(challenge_, in.fixed<std::uint64_t>(), "");
}

}  // namespace saker::flight
