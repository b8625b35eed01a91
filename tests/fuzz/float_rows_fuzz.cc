#include "fuzz.h"
#include "saker/lidar/kitti_folder.h"

namespace saker::lidar {

void fuzz::run(ByteView input) {
  KittiFolder source(file_of(input, ".bin"));
  read_all(source);
}

}  // namespace saker::lidar
