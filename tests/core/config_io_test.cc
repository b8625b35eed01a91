#include "saker/core/config_io.h"

#include <gtest/gtest.h>

#include <functional>

#include "saker/core/error.h"

namespace saker::core {
namespace {

enum class Filter { none, voxel, random };

std::vector<std::string> enum_names(Filter) { return {"none", "voxel", "random"}; }

struct Gate {
  double distance_m = 2;
  bool robust = true;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("distance_m", distance_m, {0.1, 10}, "m", "how far a point may be");
    v.field("robust", robust, "", "whether outliers are weighted down");
  }
};

struct Root {
  int most = 20;
  Filter filter = Filter::voxel;
  std::string model = "configs/models/net.onnx";
  std::vector<double> weights = {1, 0.25};
  std::vector<std::string> names = {"a", "b c"};
  Gate gate;
  std::vector<Gate> gates = {Gate{}, Gate{.distance_m = 3, .robust = false}};

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("most", most, {1, 100}, "", "points of a voxel");
    v.field("filter", filter, "", "which points are used");
    v.field("model", model, "", "weights of the network");
    v.field("weights", weights, {0, 5}, "", "one a class");
    v.field("names", names, "", "one a class");
    v.group("gate", gate, "data association");
    v.list("gates", gates, "one a class");
  }
};

Root parse(const std::string& yaml) { return config_from_yaml<Root>(yaml, "f.yaml"); }
Root set(const std::string& setting) { return config_with_setting(setting, Root()); }

std::string message(const std::function<void()>& f) {
  try {
    f();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}
std::string complaint(const std::string& yaml) {
  return message([&] { (void)parse(yaml); });
}
std::string complaint_about(const std::string& setting) {
  return message([&] { (void)set(setting); });
}

TEST(ConfigIo, WhatTheFileDoesNotNameKeepsItsDefault) {
  const Root root = parse("most: 7\ngate:\n  distance_m: 0.5\n");
  EXPECT_EQ(root.most, 7);
  EXPECT_EQ(root.gate.distance_m, 0.5);
  EXPECT_TRUE(root.gate.robust);
  EXPECT_EQ(root.gates.size(), 2u);
  EXPECT_EQ(parse("").most, 20);
  EXPECT_EQ(parse("gate:\n").gate.distance_m, 2);
}

TEST(ConfigIo, EveryKindOfValueIsRead) {
  const Root root = parse(
      "filter: random\nmodel: \"x y\"\nweights: [0, 1e-3, 5]\nnames: []\n"
      "gates:\n  - robust: false\n  - {distance_m: 9}\n  - {}\n");
  EXPECT_EQ(root.filter, Filter::random);
  EXPECT_EQ(root.model, "x y");
  EXPECT_EQ(root.weights, (std::vector<double>{0, 1e-3, 5}));
  EXPECT_TRUE(root.names.empty());
  ASSERT_EQ(root.gates.size(), 3u);
  EXPECT_FALSE(root.gates[0].robust);
  EXPECT_EQ(root.gates[1].distance_m, 9);
  EXPECT_EQ(root.gates[2].distance_m, 2);
}

TEST(ConfigIo, AnUnknownKeyIsRefusedWithItsLineAndTheNearestKey) {
  EXPECT_EQ(complaint("most: 7\n\ngate:\n  distanc_m: 1\n"),
            "f.yaml:4: gate.distanc_m: unknown key, the nearest is gate.distance_m");
  EXPECT_EQ(complaint("distance_m: 1\n"),
            "f.yaml:1: distance_m: unknown key, the nearest is gate.distance_m");
  EXPECT_EQ(complaint("gates:\n  - robst: true\n"),
            "f.yaml:2: gates[0].robst: unknown key, the nearest is gates[0].robust");
}

TEST(ConfigIo, AWrongTypeIsRefused) {
  EXPECT_EQ(complaint("most: many\n"), "f.yaml:1: most: \"many\", expected an integer");
  EXPECT_EQ(complaint("most: 1.5\n"), "f.yaml:1: most: \"1.5\", expected an integer");
  EXPECT_EQ(complaint("most:\n"), "f.yaml:1: most: nothing, expected an integer");
  EXPECT_EQ(complaint("gate: 3\n"), "f.yaml:1: gate: \"3\", expected a group of keys");
  EXPECT_EQ(complaint("gate: {robust: maybe}\n"),
            "f.yaml:1: gate.robust: \"maybe\", expected true or false");
  EXPECT_EQ(complaint("filter: voxl\n"),
            "f.yaml:1: filter: \"voxl\", expected one of none, voxel, random");
  EXPECT_EQ(complaint("weights: 3\n"), "f.yaml:1: weights: \"3\", expected a list");
  EXPECT_EQ(complaint("model: [a]\n"), "f.yaml:1: model: a list, expected a text");
  EXPECT_EQ(complaint("- 1\n"), "f.yaml:1: a list, expected a group of keys");
}

TEST(ConfigIo, AValueOutOfRangeIsRefused) {
  EXPECT_EQ(complaint("gate:\n  distance_m: 11\n"),
            "f.yaml:2: gate.distance_m: \"11\", expected 0.1 … 10 m");
  EXPECT_EQ(complaint("gate:\n  distance_m: .nan\n"),
            "f.yaml:2: gate.distance_m: \".nan\", expected a number");
  EXPECT_EQ(complaint("weights: [1, 6]\n"), "f.yaml:1: weights: \"6\", expected 0 … 5");
}

TEST(ConfigIo, WhatIsNotYamlOrNamedTwiceIsRefused) {
  EXPECT_EQ(complaint("most: 1\nmost: 2\n"), "f.yaml:2: most: named twice");
  EXPECT_EQ(complaint("most: 1\ngate: [\n").substr(0, 9), "f.yaml:3:");
  EXPECT_EQ(message([] { (void)load_config<Root>("/no/such.yaml", {}); }),
            "cannot read /no/such.yaml: No such file or directory");
}

TEST(ConfigIo, ASettingChangesOneKey) {
  EXPECT_EQ(set("most=3").most, 3);
  EXPECT_EQ(set("gate.distance_m=0.3").gate.distance_m, 0.3);
  EXPECT_EQ(set("weights=[1, 2]").weights, (std::vector<double>{1, 2}));
  EXPECT_EQ(set("filter=none").filter, Filter::none);
  const Root root = set("gates[1].robust=true");
  EXPECT_TRUE(root.gates[1].robust);
  EXPECT_EQ(root.gates[1].distance_m, 3);
}

TEST(ConfigIo, LaterSettingsWin) { EXPECT_EQ(load_config<Root>("", {"most=3", "most=4"}).most, 4); }

TEST(ConfigIo, AWrongSettingIsNamed) {
  EXPECT_EQ(complaint_about("gate.robst=true"),
            "--set gate.robst=true: gate.robst: unknown key, the nearest is gate.robust");
  EXPECT_EQ(complaint_about("most=0"), "--set most=0: most: \"0\", expected 1 … 100");
  EXPECT_EQ(complaint_about("most"), "--set most: expected KEY=VALUE");
  EXPECT_EQ(complaint_about("gates[7].robust=true").substr(0, 43),
            "--set gates[7].robust=true: gates[7]: unkno");
  EXPECT_EQ(complaint_about("most.x=1"), "--set most.x=1: most: a group, expected an integer");
}

TEST(ConfigIo, WhatIsSavedIsReadBackTheSame) {
  Root root;
  root.most = 99;
  root.filter = Filter::none;
  root.model = "true";
  root.weights = {0.1, 1.0 / 3};
  root.names = {"", "a: b # \"c\"", "null", "12", "-x"};
  root.gates[0].distance_m = 7.25;
  const std::string saved = config_to_yaml(root);
  const Root read = parse(saved);
  EXPECT_EQ(config_to_yaml(read), saved);
  EXPECT_EQ(read.weights, root.weights);
  EXPECT_EQ(read.names, root.names);
  EXPECT_EQ(read.model, "true");
}

TEST(ConfigIo, EveryKeyIsSavedWithUnitRangeAndMeaning) {
  const std::string saved = config_to_yaml(Root());
  EXPECT_EQ(saved,
            "most: 20  # 1 … 100: points of a voxel\n"
            "filter: voxel  # which points are used\n"
            "model: configs/models/net.onnx  # weights of the network\n"
            "weights: [1, 0.25]  # 0 … 5: one a class\n"
            "names: [a, \"b c\"]  # one a class\n"
            "gate:  # data association\n"
            "  distance_m: 2  # m, 0.1 … 10: how far a point may be\n"
            "  robust: true  # whether outliers are weighted down\n"
            "gates:  # one a class\n"
            "  - distance_m: 2  # m, 0.1 … 10: how far a point may be\n"
            "    robust: true  # whether outliers are weighted down\n"
            "  - distance_m: 3\n"
            "    robust: false\n");
}

struct Mixed {
  double speed = 2;
  int rounds = 3;
  Gate gate;
  struct Site {
    double height_m = 4;
    double cell_m = 1;

    template <class Visitor>
    void visit(Visitor& v) {
      v.setting("height_m", height_m, {0, 9}, "m", "Flown so high.");
      v.field("cell_m", cell_m, {0.1, 2}, "m", "edge of a cell");
    }
  } site;
  std::vector<Gate> gates = std::vector<Gate>(1);

  template <class Visitor>
  void visit(Visitor& v) {
    v.setting("speed", speed, {0.1, 9}, "m/s", "Never faster.");
    v.field("rounds", rounds, {1, 9}, "", "of the search");
    v.group("gate", gate, "data association");
    v.group("site", site, "where");
    v.list("gates", gates, "one a class");
  }
};

TEST(ConfigIo, SettingsAreSavedAlone) {
  EXPECT_EQ(config_to_yaml(Mixed(), Written::settings),
            "speed: 2  # m/s, 0.1 … 9: Never faster.\n"
            "site:  # where\n"
            "  height_m: 4  # m, 0 … 9: Flown so high.\n");
}

TEST(ConfigIo, WhatIsNoSettingIsMarkedOnceAGroup) {
  EXPECT_EQ(config_to_yaml(Mixed(), Written::all_marked),
            "speed: 2  # m/s, 0.1 … 9: Never faster.\n"
            "rounds: 3  # ~ 1 … 9: of the search\n"
            "gate:  # ~ data association\n"
            "  distance_m: 2  # m, 0.1 … 10: how far a point may be\n"
            "  robust: true  # whether outliers are weighted down\n"
            "site:  # where\n"
            "  height_m: 4  # m, 0 … 9: Flown so high.\n"
            "  cell_m: 1  # ~ m, 0.1 … 2: edge of a cell\n"
            "gates:  # ~ one a class\n"
            "  - distance_m: 2  # m, 0.1 … 10: how far a point may be\n"
            "    robust: true  # whether outliers are weighted down\n");
}

TEST(ConfigIo, ASettingIsReadAndCheckedAsAFieldIs) {
  EXPECT_EQ(config_with_setting("site.height_m=5", Mixed()).site.height_m, 5);
  EXPECT_EQ(message([] { (void)config_with_setting("speed=10", Mixed()); }),
            "--set speed=10: speed: \"10\", expected 0.1 … 9 m/s");
  Mixed fast;
  fast.speed = 10;
  EXPECT_EQ(message([&] { (void)checked(fast, "mixed"); }), "mixed.speed: 10, expected 0.1 … 9");
}

TEST(ConfigIo, AnEarlierVersionsKeysGoToTheirNewPlaces) {
  const MovedKey moved[] = {
      {"pace", "speed", ""}, {"old.gate", "gate", ""}, {"old", nullptr, "why"}};
  std::vector<std::string> lines;
  const ConfigHistory history{moved, [&](const std::string& line) { lines.push_back(line); }};
  const Mixed read = config_from_yaml("pace: 5\nold: {gate: {robust: false}, x: {y: 1}}\n",
                                      "f.yaml", Mixed(), history);
  EXPECT_EQ(read.speed, 5);
  EXPECT_FALSE(read.gate.robust);
  EXPECT_EQ(lines, (std::vector<std::string>{"f.yaml: pace: is now speed",
                                             "f.yaml: old.gate.robust: is now gate.robust",
                                             "f.yaml: old.x.y: is gone and ignored: why"}));
  EXPECT_EQ(message([&] { (void)config_from_yaml("pace: 50\n", "f.yaml", Mixed(), history); }),
            "f.yaml:1: speed: \"50\", expected 0.1 … 9 m/s");
}

TEST(ConfigIo, AStageChecksAConfigThatCameFromElsewhere) {
  Root root;
  root.gates[1].distance_m = 50;
  EXPECT_EQ(message([&] { (void)checked(root, "root"); }),
            "root.gates[1].distance_m: 50, expected 0.1 … 10");
  EXPECT_EQ(checked(Root(), "root").most, 20);
}

}  // namespace
}  // namespace saker::core
