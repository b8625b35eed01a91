#include "fuzz.h"
#include "saker/exchange/seal.h"

/// Datagrams of the radio. The first two bytes say where one that is sealed with the input as its
/// payload is changed, by the third; then the input itself is taken for a datagram.
namespace saker {

void lidar::fuzz::run(ByteView input) {
  static const exchange::Key team{};
  static const exchange::Key robot = exchange::key_of(team, "R1").value();
  static const std::string channel = "R1_LINK";
  static exchange::Sealer sealer(robot, "R1", "");
  Cursor cursor(input);
  const std::size_t place = cursor.number<std::uint16_t>();
  const auto change = static_cast<char>(cursor.number<std::uint8_t>());
  const std::string_view payload = text_of(cursor.take_at_most(exchange::kLongestPayload));
  std::string sealed = sealer.seal(channel, payload).value();
  const auto genuine = exchange::unsealed(team, "BASE", channel, sealed);
  expect(genuine.verdict == exchange::Verdict::genuine && genuine.payload == payload);
  expect(unsealed(team, "BASE", "R2_LINK", sealed).verdict != exchange::Verdict::genuine);
  sealed[place % sealed.size()] = static_cast<char>(sealed[place % sealed.size()] ^ change);
  const auto changed = exchange::unsealed(team, "BASE", channel, sealed);
  expect((changed.verdict == exchange::Verdict::genuine) == (change == 0));
  sealed.resize(place % sealed.size());
  expect(unsealed(team, "BASE", channel, sealed).verdict != exchange::Verdict::genuine);
  expect(unsealed(team, "BASE", channel, text_of(input)).verdict != exchange::Verdict::genuine);
}

}  // namespace saker
