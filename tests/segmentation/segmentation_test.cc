#include "saker/segmentation/segmentation.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "lidar/made_scan.h"
#include "saker/core/config_folder.h"
#include "saker/core/error.h"

namespace saker::segmentation {
namespace {

namespace fs = std::filesystem;
using lidar::testing::MadeScan;

/// Share of the points chosen by `chosen` that have the class.
template <class Chosen>
double share(const lidar::Scan& scan, const lidar::Labels& labels, std::uint8_t id, Chosen chosen) {
  double there = 0, all = 0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (!scan.points[i].allFinite() || !chosen(scan.points[i])) continue;
    all += 1;
    there += labels.classes[i] == id ? 1 : 0;
  }
  return there / std::max(all, 1.0);
}

class ShippedModel : public ::testing::Test {
 protected:
  objects::ClassTable table_;
  Segmentation segmentation_{SegmentationConfig{}, table_};
};

TEST_F(ShippedModel, TellsTheGroundFromAWallInAnyFormOfScan) {
  const lidar::Scan organised = MadeScan{}.organised();
  const std::vector<lidar::Scan> scans = {organised, lidar::testing::ring_by_ring(organised).scan,
                                          MadeScan{.rows = 128, .columns = 2048}.organised(),
                                          MadeScan{.rows = 32, .columns = 512}.organised()};
  const std::uint8_t ground = table_.find("ground");
  for (const lidar::Scan& scan : scans) {
    const lidar::Labels labels = segmentation_.segment(scan);
    ASSERT_EQ(labels.classes.size(), scan.size());
    ASSERT_EQ(labels.probability.size(), scan.size());
    EXPECT_GT(share(scan, labels, ground, [](auto& p) { return p.z() < -1.9F && p.norm() < 19; }),
              0.95);
    EXPECT_LT(share(scan, labels, ground, [](auto& p) { return p.z() > -1.0F; }), 0.05);
  }
}

TEST_F(ShippedModel, GivesTheSameBytesForTheSameScan) {
  const lidar::Scan scan = MadeScan{}.organised();
  const lidar::Labels first = segmentation_.segment(scan);
  (void)segmentation_.segment(MadeScan{.rows = 16, .columns = 512}.organised());
  const lidar::Labels second = segmentation_.segment(scan);
  EXPECT_EQ(first.classes, second.classes);
  EXPECT_EQ(first.probability, second.probability);
}

/// Share of points that are called the same in a mirror.
double share_in_mirror(bool mirrored) {
  Segmentation segmentation({.mirrored = mirrored}, objects::ClassTable{});
  const lidar::Scan scan = lidar::testing::with_handedness(MadeScan{}.organised());
  const lidar::Labels labels = segmentation.segment(scan);
  const lidar::Labels other = segmentation.segment(lidar::testing::mirrored(scan));
  double same = 0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const std::size_t column = i % scan.columns;
    const std::size_t there = i - column + scan.columns - 1 - column;
    same += std::abs(labels.probability[i] - other.probability[there]) < 0.01F ? 1 : 0;
  }
  return same / static_cast<double>(scan.size());
}

TEST(Mirror, ChangesNoLabel) {
  EXPECT_GT(share_in_mirror(true), 0.995);
  EXPECT_LT(share_in_mirror(false), share_in_mirror(true));
}

TEST_F(ShippedModel, CallsEverythingOtherWhereThereIsNothing) {
  EXPECT_TRUE(segmentation_.segment(lidar::Scan{}).classes.empty());
  lidar::Scan organised = MadeScan{}.organised();
  for (auto& p : organised.points) p.setConstant(NAN);
  lidar::Scan unorganised = organised;
  unorganised.rows = unorganised.columns = 0;
  for (const lidar::Scan& scan : {organised, unorganised}) {
    const lidar::Labels labels = segmentation_.segment(scan);
    ASSERT_EQ(labels.classes.size(), scan.size());
    for (std::size_t i = 0; i < scan.size(); ++i) {
      ASSERT_EQ(labels.classes[i], 0);
      ASSERT_EQ(labels.probability[i], 0);
    }
  }
}

TEST_F(ShippedModel, ShowsThePiecesThatItDecidesOn) {
  const lidar::Scan scan = MadeScan{}.organised();
  for (const auto& piece : segmentation_.pieces(scan)) {
    ASSERT_FALSE(piece.points.empty());
    for (const std::int32_t i : piece.points) ASSERT_TRUE(scan.points[i].allFinite());
  }
  EXPECT_TRUE(segmentation_.pieces(lidar::Scan{}).empty());
}

TEST_F(ShippedModel, GivesProbabilities) {
  const lidar::Labels labels = segmentation_.segment(MadeScan{}.organised());
  for (const float p : labels.probability) {
    ASSERT_GE(p, 0);
    ASSERT_LE(p, 1);
  }
}

/// A copy of the shipped model whose description can be spoilt.
class SpoiltModel : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_);
    const fs::path shipped = core::find_in_configs(SegmentationConfig{}.model, "model");
    fs::copy_file(shipped, model_, fs::copy_options::overwrite_existing);
    std::ifstream in(fs::path(shipped).replace_extension(".yaml"));
    description_.assign(std::istreambuf_iterator<char>(in), {});
  }
  void TearDown() override { fs::remove_all(folder_); }

  void describe(const std::string& text) const {
    std::ofstream(fs::path(model_).replace_extension(".yaml")) << text;
  }
  [[nodiscard]] std::string with(const std::string& from, const std::string& to) const {
    std::string text = description_;
    return text.replace(text.find(from), from.size(), to);
  }
  [[nodiscard]] std::string refusal() const {
    try {
      Segmentation(SegmentationConfig{.model = model_}, objects::ClassTable{});
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  fs::path folder_ =
      fs::path(::testing::TempDir()) /
      ("saker_model_" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) +
       ::testing::UnitTest::GetInstance()->current_test_info()->name());
  fs::path model_ = folder_ / "model.onnx";
  std::string description_;
};

TEST_F(SpoiltModel, IsTakenAsLongAsItIsWhole) {
  describe(description_);
  EXPECT_EQ(refusal(), "");
}

TEST_F(SpoiltModel, IsRefusedInOneLineThatSaysWhy) {
  EXPECT_NE(refusal().find("not found"), std::string::npos) << "no description";
  describe(with("classes:\n- other", "classes:\n- tree"));
  EXPECT_NE(refusal().find("tree"), std::string::npos) << "another class";
  describe(with("outputs:\n", "outputs:\n- one_more\n"));
  EXPECT_NE(refusal().find("one an output"), std::string::npos) << "an output without a class";
  describe(with("- slope", "- colour"));
  EXPECT_NE(refusal().find("colour"), std::string::npos) << "another channel";
  describe(with("sha256:", "md5:"));
  EXPECT_NE(refusal().find("'sha256' is missing"), std::string::npos) << "no digest";
  describe(with("    crowned_to_bare:", "    colour:"));
  EXPECT_NE(refusal().find("crowned_to_bare"), std::string::npos) << "a weight that is missing";
  describe(with("    crowned_to_bare:", "    colour: 1\n    crowned_to_bare:"));
  EXPECT_NE(refusal().find("8 weights"), std::string::npos) << "one too many";
  describe(with("    crowned_to_bare: ", "    crowned_to_bare: .nan  # "));
  EXPECT_NE(refusal().find("crowned_to_bare"), std::string::npos) << "one that is no number";
  describe(with("  bare:\n", "  pole:\n"));
  EXPECT_NE(refusal().find("'bare' is missing"), std::string::npos) << "a kind without weights";
  describe("[a: {");
  EXPECT_NE(refusal().find("not YAML"), std::string::npos) << "no YAML";
  describe(description_);
  std::ofstream(model_, std::ios::app) << "x";
  EXPECT_NE(refusal().find("sha256"), std::string::npos) << "changed weights";
  for (const std::string& line : {refusal()}) EXPECT_EQ(line.find('\n'), std::string::npos);
}

TEST(Model, ThatIsNotThereIsRefusedWithThePlacesWhereItWasSought) {
  try {
    Segmentation(SegmentationConfig{.model = "models/none.onnx"}, objects::ClassTable{});
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("configs/models/none.onnx"), std::string::npos);
  }
}

}  // namespace
}  // namespace saker::segmentation
