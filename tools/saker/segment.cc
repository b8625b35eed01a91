#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <vector>

#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/core/progress.h"
#include "saker/lidar/recording.h"
#include "saker/segmentation/segmentation.h"
#include "tools/saker/command.h"
#include "tools/saker/configuration.h"
#include "tools/saker/recording_input.h"

namespace saker::tools {
namespace {

struct SegmentOptions {
  RecordingInput input;
};

template <class T>
void write_values(const std::filesystem::path& file, const std::vector<T>& values) {
  const std::string_view bytes(reinterpret_cast<const char*>(values.data()),
                               values.size() * sizeof(T));
  core::write_file(file, bytes);
}

/// SemanticKITTI ids and probabilities, one a point, in the order of the input.
void write_labels(const OutputFolder& out, const std::string& name, const lidar::Labels& labels,
                  const objects::ClassTable& table) {
  std::vector<std::uint32_t> ids;
  ids.reserve(labels.classes.size());
  for (const std::uint8_t id : labels.classes) ids.push_back(table.label_of(id));
  write_values(out / ("labels/" + name + ".label"), ids);
  write_values(out / ("probability/" + name + ".f32"), labels.probability);
}

int segment(const SegmentOptions& options, const CommonOptions& common) {
  const autonomy::Config config = read_configuration(common).autonomy;
  segmentation::Segmentation stage(config.segmentation, config.objects);
  const auto source = options.input.open();
  const OutputFolder out(common);
  out.folder("labels");
  out.folder("probability");
  core::Progress progress("segment", source->expected_scans());
  int done = 0, faulty = 0;
  while (const auto frame = source->next()) {
    if (frame->fault.empty()) {
      write_labels(out, frame->name, stage.segment(frame->scan), config.objects);
    } else {
      spdlog::warn("{}: {}", frame->name, frame->fault);
      ++faulty;
    }
    progress.update(++done);
  }
  spdlog::info("{} scans, {} of them could not be read", done, faulty);
  if (done == faulty) throw Error(options.input.path + ": no scan could be read");
  return 0;
}

}  // namespace

void add_segment(Commands& commands) {
  auto options = std::make_shared<SegmentOptions>();
  CLI::App& app = commands.add(
      {.name = "segment",
       .does =
           "class and probability of every point: OUT/labels/STEM.label, OUT/probability/STEM.f32",
       .output = Output::folder,
       .example = "saker segment drive/velodyne -o out"},
      [options](const CommonOptions& common) { return segment(*options, common); });
  add_recording_input(app, "INPUT", options->input);
}

}  // namespace saker::tools
