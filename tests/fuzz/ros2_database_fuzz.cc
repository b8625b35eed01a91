#include "fuzz.h"
#include "saker/lidar/bags/bag_recording.h"

namespace saker::lidar {

void fuzz::run(ByteView input) {
  BagRecording source({RecordingKind::kRos2Database, {file_of(input, ".db3")}}, {});
  read_all(source);
}

}  // namespace saker::lidar
