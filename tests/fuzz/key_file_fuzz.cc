#include "flight/mavlink/signing.h"
#include "fuzz.h"
#include "saker/exchange/key.h"

/// Files of keys: the team's or a robot's, and the one that signs MAVLink.
namespace saker {

void lidar::fuzz::run(ByteView input) {
  const std::filesystem::path file = file_of(input, ".key");
  std::filesystem::permissions(
      file, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  try {
    (void)flight::mavlink::read_signing_key(file);
  } catch (const Error&) {
  }
  const exchange::Key key = exchange::read_key(file);
  expect(exchange::key_of(key, key.robot.empty() ? "R1" : key.robot).has_value());
}

}  // namespace saker
