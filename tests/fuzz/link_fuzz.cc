#include "flight/link/fragments.h"
#include "flight/link/session.h"
#include "fuzz.h"

/// What the sealed link makes of genuine datagrams, as a robot that was taken over could seal them:
/// of each a byte of what it is, one of its epoch, one of its counter and two of the length of its
/// body.
namespace saker {
namespace {

using flight::Session;

/// Both ends' sessions; what one takes goes on to the joiners.
class Ends {
 public:
  void hear(std::uint8_t what, exchange::Opened message) {
    const bool answers = (what & 1) != 0;  // brings the challenge that is open
    if (answers) message.payload = ours_.payload(message.payload);
    now_ += std::chrono::milliseconds((what & 6) == 6 ? 2000 : 10);
    const Session::Heard heard = theirs_.open(now_, message);
    if (heard.outcome == Session::Outcome::asks) {
      (void)ours_.open(
          now_, {exchange::Verdict::genuine, "GROUND", theirs_.answer(message), 1, ++counter_});
    }
    if ((what & 8) != 0) theirs_.end();
    join(heard.body);
  }

 private:
  void join(std::string_view body) {
    const auto fragment = flight::fragment_of(body);
    if (!fragment) return;
    lidar::fuzz::expect(flight::fragment_of(to_bytes(*fragment)).has_value());
    for (flight::FragmentJoiner* joiner : {&every_, &newest_}) (void)joiner->add(*fragment);
  }

  Session ours_{1, 0.5}, theirs_{1, 0.5};
  Session::Steady::time_point now_{};
  std::uint64_t counter_ = 0;
  flight::FragmentJoiner every_{true}, newest_{false};
};

}  // namespace

void lidar::fuzz::run(ByteView input) {
  Ends ends;
  for (Cursor cursor(input); cursor.left() > 0;) {
    const auto what = cursor.number<std::uint8_t>();
    exchange::Opened message{exchange::Verdict::genuine, "R1"};
    message.epoch = cursor.number<std::uint8_t>();
    message.counter = cursor.number<std::uint8_t>();
    message.payload = text_of(cursor.take_at_most(cursor.number<std::uint16_t>()));
    ends.hear(what, std::move(message));
  }
}

}  // namespace saker
