#include <string>

#include "fuzz.h"
#include "saker/exchange/message.h"
#include "saker/exchange/peer.h"
#include "saker/exchange/store.h"

/// What a counterpart says in the exchange, opened: two bytes of the length of each message, whose
/// highest bit says that a second has passed, and the message.
namespace saker {
namespace {

using namespace exchange;
using lidar::fuzz::expect;

/// What is a message can be said again, in other bytes perhaps, and means the same.
void expect_readable_again(std::string_view bytes) {
  const auto message = message_of(bytes);
  if (!message) return;
  const auto again = std::visit([](const auto& m) { return to_bytes(m); }, *message);
  const auto read = message_of(again);
  expect(read.has_value() && read->index() == message->index());
}

}  // namespace

void lidar::fuzz::run(ByteView input) {
  constexpr std::uint16_t kPassed = 0x8000;
  MemoryStore own;
  expect(own.append({"R2", StreamKind::history, 1}, std::string(3 * kChunkBytes / 2, 'x')));
  Peer peer({}, Role::answers, own);
  Time now = kNanosecondsPerSecond;
  for (Cursor cursor(input); cursor.left() > 0;) {
    const auto head = cursor.number<std::uint16_t>();
    const std::string_view bytes = text_of(cursor.take_at_most(head & (kPassed - 1)));
    expect_readable_again(bytes);
    peer.receive(now, bytes);
    if ((head & kPassed) != 0) now += kNanosecondsPerSecond;
    for (int i = 0; i < 8; ++i) {
      const auto answer = peer.next(now, 0);
      if (!answer) break;
      expect(answer->size() <= kLongestMessage && message_of(*answer).has_value());
    }
  }
  for (const auto& [id, extent] : own.extents()) {
    expect(is_name(id.robot) && own.bytes(id).size() == extent.contiguous);
  }
}

}  // namespace saker
