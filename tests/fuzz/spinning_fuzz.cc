#include "fuzz.h"
#include "saker/lidar/spinning/spinning_stream.h"

namespace saker::lidar {

/// The first byte chooses the sensor; packets of its size follow one another, each behind the time
/// of its reception.
void fuzz::run(ByteView input) {
  using enum SpinningKind;
  constexpr std::pair<SpinningKind, std::size_t> kSensors[] = {
      {kVlp16, 1206},    {kVlp32c, 1206}, {kHdl32e, 1206}, {kHdl64e, 1206},
      {kPandar64, 1198}, {kXt32, 1080},   {kQt64, 1072}};
  Cursor cursor(input);
  const auto& [kind, bytes] = kSensors[cursor.number<std::uint8_t>() % std::size(kSensors)];
  SpinningStream stream(spinning_model(kind));
  while (cursor.left() > 0) {
    const auto received = cursor.number<std::int64_t>();
    stream.add(cursor.take_at_most(bytes), received);
  }
  stream.finish();
  while (const auto frame = stream.take()) expect_consistent(*frame);
}

}  // namespace saker::lidar
