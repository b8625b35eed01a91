#include "fuzz.h"
#include "saker/lidar/bags/bag_recording.h"

namespace saker::lidar {

void fuzz::run(ByteView input) {
  BagRecording source({RecordingKind::kMcap, {file_of(input, ".mcap")}}, {});
  read_all(source);
}

}  // namespace saker::lidar
