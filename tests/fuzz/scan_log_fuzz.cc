#include "flight/bus/scan_log.h"
#include "fuzz.h"

/// A log of lcm-logger.
namespace saker {

void lidar::fuzz::run(ByteView input) {
  const std::filesystem::path file = file_of(input, ".lcm");
  (void)flight::is_lcm_log(file);
  flight::ScanLog source(file);
  read_all(source);
}

}  // namespace saker
