#include "fuzz.h"
#include "saker/lidar/spinning/calibration_file.h"
#include "saker/segmentation/sidecar.h"
#include "saker/uncertainty/model_file.h"

/// Files of models: the first byte says whether of uncertainty (sealed here, so that what is behind
/// the check sum is read, or as it is), of the network's description or of a unit's calibration.
namespace saker {
namespace {

const objects::ClassTable kTable;

void read_uncertainty(const std::string& text) {
  const auto model = uncertainty::model_from_text(text, "model.yaml", kTable);
  (void)uncertainty::model_from_text(uncertainty::model_text(model, kTable), "again", kTable);
  for (int id = 0; id < kTable.size(); ++id) {
    const auto each = static_cast<objects::ClassId>(id);
    if (!model.knows(each)) continue;
    uncertainty::View view;
    view.range = 8;
    view.angle = 0.5;
    (void)model.predict(each, view);
  }
}

void read_sidecar(const std::filesystem::path& file) {
  const segmentation::Sidecar sidecar = segmentation::read_sidecar(file);
  (void)segmentation::check_sidecar(sidecar, file, kTable, "weights");
}

void calibrate(const std::filesystem::path& file, lidar::SpinningKind kind) {
  lidar::SpinningModel model = lidar::spinning_model(kind);
  lidar::read_calibration(file, model);
}

}  // namespace

void lidar::fuzz::run(ByteView input) {
  Cursor cursor(input);
  const auto which = cursor.number<std::uint8_t>();
  const ByteView rest = cursor.take_at_most(input.size());
  switch (which) {
    case 'u':
      return read_uncertainty(uncertainty::sealed(text_of(rest)));
    case 's':
      return read_sidecar(file_of(rest, ".yaml"));
    case 'v':
      return calibrate(file_of(rest, ".yaml"), SpinningKind::kHdl64e);
    case 'x':
      return calibrate(file_of(rest, ".xml"), SpinningKind::kHdl64e);
    case 'c':
      return calibrate(file_of(rest, ".csv"), SpinningKind::kPandar64);
    default:
      return read_uncertainty(std::string(text_of(rest)));
  }
}

}  // namespace saker
