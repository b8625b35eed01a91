#include "fuzz.h"
#include "saker/lidar/clouds/cloud_folder.h"

namespace saker::lidar {

void fuzz::run(ByteView input) {
  CloudFolder source(file_of(input, ".ply"));
  read_all(source);
}

}  // namespace saker::lidar
