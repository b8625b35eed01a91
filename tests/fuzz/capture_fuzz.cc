#include "fuzz.h"
#include "saker/lidar/metadata.h"
#include "saker/lidar/ouster_capture.h"

namespace saker::lidar {

void fuzz::run(ByteView input) {
  static const std::filesystem::path metadata = [] {
    const std::string json = metadata_json(sensor(PacketProfile::kRng15Rfl8Nir8));
    return file_of({reinterpret_cast<const std::uint8_t*>(json.data()), json.size()}, ".json");
  }();
  OusterCapture source(file_of(input, ".pcap"), metadata, true);
  read_all(source);
}

}  // namespace saker::lidar
