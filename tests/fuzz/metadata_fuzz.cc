#include "fuzz.h"
#include "saker/lidar/metadata.h"
#include "saker/lidar/scan_assembler.h"

namespace saker::lidar {

void fuzz::run(ByteView input) {
  const SensorInfo info = parse_metadata(std::string(text_of(input)), "metadata");
  const ScanAssembler assembler(info);
  (void)parse_metadata(metadata_json(info), "metadata that was written");
}

}  // namespace saker::lidar
