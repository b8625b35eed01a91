#include <array>

#include "flight/mavlink/parameter_table.h"
#include "fuzz.h"
#include "saker/core/config_io.h"
#include "saker/objects/class_table.h"

/// Configurations in YAML and settings of a command line: the first byte says of what. What can be
/// read can be written, and read again.
namespace saker {
namespace {

using lidar::fuzz::expect;

enum class Filter { none, voxel };
std::vector<std::string> enum_names(Filter) { return {"none", "voxel"}; }

struct Gate {
  double distance_m = 2;
  bool robust = true;

  template <class Visitor>
  void visit(Visitor& v) {
    v.setting("distance_m", distance_m, {0.1, 10}, "m", "how far");
    v.field("robust", robust, "", "whether");
  }
};

/// A field of each kind.
struct Root {
  int most = 20;
  Filter filter = Filter::voxel;
  std::string model = "net.onnx";
  std::vector<double> weights = {1, 0.25};
  std::vector<std::string> names = {"a", "b c"};
  Gate gate;
  std::vector<Gate> gates = {Gate{}, Gate{}};

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("most", most, {1, 100}, "", "points");
    v.setting("filter", filter, "", "which");
    v.field("model", model, "", "weights");
    v.field("weights", weights, {0, 5}, "", "one a class");
    v.field("names", names, "", "one a class");
    v.group("gate", gate, "association");
    v.list("gates", gates, "one a class");
  }
};

constexpr std::array<core::MovedKey, 3> kMoved = {{{"old", "gate", nullptr},
                                                   {"old.far", "gate.distance_m", nullptr},
                                                   {"gone", nullptr, "nothing holds"}}};
const core::ConfigHistory kHistory{kMoved};

template <class Config>
void expect_readable_again(const Config& config) {
  const std::string text = core::config_to_yaml(config);
  expect(core::config_to_yaml(core::config_from_yaml<Config>(text, "again.yaml")) == text);
}

}  // namespace

void lidar::fuzz::run(ByteView input) {
  Cursor cursor(input);
  const auto which = cursor.number<std::uint8_t>();
  const std::string text(text_of(cursor.take_at_most(input.size())));
  switch (which % 4) {
    case 0:
      return expect_readable_again(core::config_from_yaml<Root>(text, "f.yaml", {}, kHistory));
    case 1:
      return expect_readable_again(core::config_with_setting(text, Root(), kHistory));
    case 2:
      return expect_readable_again(core::config_from_yaml<objects::ClassTable>(text, "c.yaml"));
    default:
      (void)flight::mavlink::read_parameter_table(file_of(bytes_of(text), ".yaml"), 255);
  }
}

}  // namespace saker
