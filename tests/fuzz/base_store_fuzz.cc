#include <spdlog/spdlog.h>

#include "flight/base_station/store.h"
#include "fuzz.h"

/// A SQLite file that is given to saker-base or to `saker base` as a store.
namespace saker {

void lidar::fuzz::run(ByteView input) {
  static const bool quiet = (spdlog::set_level(spdlog::level::off), true);
  expect(quiet);
  const std::filesystem::path file = file_of(input, ".db");
  for (const char* beside : {"-wal", "-shm", "-journal"}) {
    std::filesystem::remove(file.string() + beside);
  }
  try {
    for (const auto& robot : flight::read_report(file.string()).robots) {
      for (const flight::StoredStream& stream : robot.streams) {
        expect(exchange::is_name(stream.id.robot) && !to_string(stream.id).empty());
      }
    }
  } catch (const Error&) {
  }
  flight::DatabaseStore store(file.string(), 100);
  for (const auto& [id, extent] : store.extents()) {
    expect(exchange::is_name(id.robot) && store.bytes(id).size() == extent.contiguous);
  }
}

}  // namespace saker
