#include "fuzz.h"
#include "saker/lidar/bags/bag_recording.h"

namespace saker::lidar {

void fuzz::run(ByteView input) {
  BagRecording source({RecordingKind::kRos1Bag, {file_of(input, ".bag")}}, {});
  read_all(source);
}

}  // namespace saker::lidar
