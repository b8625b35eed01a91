#include "tools/saker/recording_input.h"

#include <spdlog/spdlog.h>

namespace saker::tools {

std::unique_ptr<lidar::ScanSource> RecordingInput::open() const {
  auto source = lidar::open_recording(path, options);
  if (const std::string note = source->note(); !note.empty()) spdlog::info("{}", note);
  return source;
}

void add_recording_input(CLI::App& app, const std::string& name, RecordingInput& input) {
  app.add_option(name, input.path, kRecordings)->required();
  app.add_option("--meta", input.options.metadata,
                 "metadata (JSON) of an Ouster sensor, calibration of another's; else beside the "
                 "capture or in it")
      ->type_name("FILE");
  app.add_option("--sensor", input.options.sensor,
                 "serial number or address, where a capture has several sensors")
      ->type_name("SERIAL");
  app.add_option("--topic", input.options.topics,
                 "with the scans or the inertial samples, where a bag has several; repeatable")
      ->type_name("NAME")
      ->allow_extra_args(false);
  app.add_option(
         "--point-fields", input.options.point_fields,
         "floats of a point in *.bin: x,y,z,i,ring,t and _; found from the data when not given")
      ->type_name("FIELDS");
}

}  // namespace saker::tools
