#include "fuzz.h"
#include "saker/lidar/osf/osf_recording.h"

namespace saker::lidar {

void fuzz::run(ByteView input) {
  OsfRecording source(file_of(input, ".osf"));
  read_all(source);
}

}  // namespace saker::lidar
