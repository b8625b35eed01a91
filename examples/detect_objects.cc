// detect_objects RECORDING [SCAN, from 0]: vehicles, trunks and poles as JSON, in the lidar's frame
#include <saker/core/error.h>
#include <saker/detection/detection.h>
#include <saker/lidar/recording.h>
#include <saker/objects/map_io.h>
#include <saker/segmentation/segmentation.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>

namespace {

using namespace saker;

lidar::Scan nth_scan(const char* recording, int n) {
  const auto source = lidar::open_recording(recording);
  while (auto frame = source->next()) {
    if (n-- == 0) return std::move(frame->scan);
  }
  throw Error("the recording has fewer scans");
}

objects::ObjectMap as_map(const objects::Detections& detections) {
  objects::ObjectMap map;
  map.frame = "lidar";
  for (const objects::Measurement& m : detections.measurements) {
    map.objects.push_back({.id = static_cast<int>(map.objects.size()),
                           .class_id = m.class_id,
                           .class_probability = m.class_probability,
                           .observations = 1,
                           .model = m.model});
  }
  return map;
}

int run(const char* recording, int n) {
  const objects::ClassTable table;
  segmentation::Segmentation network({.model = MODELS "/segmentation.onnx"}, table);
  detection::Detection detection({}, table);
  const lidar::Scan scan = nth_scan(recording, n);
  detection::LabelledScan labelled;
  labelled.stamp = scan.stamp;
  labelled.points = std::make_shared<const std::vector<Eigen::Vector3f>>(scan.points);
  labelled.labels = std::make_shared<const lidar::Labels>(network.segment(scan));
  std::puts(objects::to_json(as_map(detection.detect({&labelled, 1})), table).c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc == 2 || argc == 3) return run(argv[1], argc == 3 ? std::atoi(argv[2]) : 0);
  std::fprintf(stderr, "usage: detect_objects RECORDING [SCAN]\n");
  return 2;
} catch (const std::exception& error) {
  std::fprintf(stderr, "detect_objects: %s\n", error.what());
  return 2;
}
