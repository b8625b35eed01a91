#include "saker/uncertainty/model_file.h"

#include <gtest/gtest.h>

#include "made_samples.h"
#include "paths.h"
#include "saker/core/error.h"
#include "saker/uncertainty/fit.h"

namespace saker::uncertainty {
namespace {

const objects::ClassTable kTable;
const objects::ClassId kVehicle = kTable.find("vehicle");

const Model& made_model() {
  static const Model model = [] {
    FitConfig config;
    config.range_edges_m = {2, 8, 14};
    config.sectors = 3;
    config.folds = 2;
    config.confidence.epochs = 3;
    MadeLaw law;
    law.covariates = true;
    return Model(fit(made_samples(law, config.range_edges_m, 30, 1), kTable, config, 7),
                 {"seeds 1 ... 30", "OS1-64, 512x10", "abc1234", 7});
  }();
  return model;
}

std::string body() {
  const std::string text = model_text(made_model(), kTable);
  return text.substr(text.find('\n', text.find("sha256: ")) + 1);
}

/// The body with its first `from` replaced, under a checksum that fits.
std::string resealed(const std::string& from, const std::string& to) {
  std::string changed = body();
  const std::size_t at = changed.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return sealed(changed.replace(at, from.size(), to));
}

void expect_refusal(const std::string& text, const std::string& expected) {
  try {
    (void)model_from_text(text, "model.yaml", kTable);
    ADD_FAILURE() << "not refused, expected: " << expected;
  } catch (const Error& error) {
    const std::string line = error.what();
    EXPECT_EQ(line.find("model.yaml"), 0u) << line;
    EXPECT_NE(line.find(expected), std::string::npos) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  }
}

TEST(ModelFileTest, WhatIsWrittenIsReadBackToTheLastBit) {
  const std::string text = model_text(made_model(), kTable);
  const Model read = model_from_text(text, "model.yaml", kTable);
  EXPECT_EQ(model_text(read, kTable), text);
  for (const double angle : {-2.0, 0.1, 3.0}) {
    const View view{6.3, angle, 0.4, 30};
    const Prediction a = made_model().predict(kVehicle, view), b = read.predict(kVehicle, view);
    EXPECT_EQ(a.confidence, b.confidence);
    EXPECT_EQ(a.bias, b.bias);
    EXPECT_EQ(a.covariance, b.covariance);
    EXPECT_EQ(a.whole, b.whole);
    EXPECT_EQ(a.cell, b.cell);
  }
  EXPECT_EQ(read.common_covariance(kVehicle), made_model().common_covariance(kVehicle));
}

TEST(ModelFileTest, SaysWhereItComesFromAndWhatWasTried) {
  const std::string text = body();
  EXPECT_NE(text.find("seeds 1 ... 30"), std::string::npos);
  EXPECT_NE(text.find("abc1234"), std::string::npos);
  EXPECT_NE(text.find("errors: elevation"), std::string::npos);
}

TEST(ModelFileTest, AFileThatWasCutIsRefused) {
  const std::string text = model_text(made_model(), kTable);
  expect_refusal(text.substr(0, text.size() / 2), "cut or edited");
  expect_refusal(text.substr(0, text.size() - 1), "cut or edited");
  expect_refusal(text.substr(0, 20), "no model file");
  expect_refusal("", "no model file");
}

TEST(ModelFileTest, AFileThatWasEditedIsRefused) {
  std::string text = model_text(made_model(), kTable);
  text.replace(text.find("abc1234"), 7, "abc1235");
  expect_refusal(text, "cut or edited");
}

TEST(ModelFileTest, AnotherVersionIsRefused) {
  expect_refusal(resealed("format: 2", "format: 1"), "format 1, expected 2");
  expect_refusal(sealed("a: 1\n"), "format none, expected 2");
  expect_refusal(sealed("a: [1\n"), "");
}

TEST(ModelFileTest, ClassesThatDoNotFitTheTableAreRefused) {
  expect_refusal(resealed("name: vehicle", "name: boat"), "class boat: expected a class");
  expect_refusal(resealed("shape: cuboid", "shape: cylinder"), "class vehicle.shape: expected");
  expect_refusal(sealed("format: 2\nclasses: []\n"), "at least one class");
}

TEST(ModelFileTest, NumbersThatAreNotValidAreRefusedWithTheirKey) {
  expect_refusal(resealed("sectors: 3", "sectors: 1"), ".errors.sectors: expected");
  expect_refusal(resealed("sectors: 3", "sectors: 4"), ".errors.intervals: expected 8 entries");
  expect_refusal(resealed("range_edges: [2, 8", "range_edges: [8, 8"), ".errors.range_edges");
  expect_refusal(resealed("common: [", "common: [-1, "), ".errors.common: expected 16 numbers");
  const std::string text = body();
  const std::size_t at = text.find("common: [") + 9;
  const std::string first = text.substr(at, text.find(',', at) - at);
  expect_refusal(resealed("common: [" + first, "common: [-" + first), "positive definite");
  expect_refusal(resealed("common: [" + first, "common: [.nan"), "expected a number");
  expect_refusal(resealed("whole: 1", "whole: 1.5"), "whole");
  expect_refusal(resealed("whole_length_sd: 0.25", "whole_length_sd: 0"), ".whole_length_sd");
  expect_refusal(resealed("common:", "komon:"), "komon");
}

TEST(ModelFileTest, AMissingFileIsNamed) {
  try {
    (void)Model::load("nowhere/uncertainty.yaml", kTable);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("nowhere/uncertainty.yaml"), std::string::npos);
  }
}

TEST(ModelFileTest, TheShippedModelIsValidAndKnowsWhatIsMapped) {
  const Model model = Model::load(source_dir() + "/configs/models/uncertainty.yaml", kTable);
  for (const char* name : {"vehicle", "trunk", "pole"}) {
    EXPECT_TRUE(model.knows(kTable.find(name))) << name;
  }
  View oblique;
  oblique.range = 9;
  oblique.angle = 0.8;
  EXPECT_FALSE(model.predict(kTable.find("vehicle"), oblique).extrapolated);
}

}  // namespace
}  // namespace saker::uncertainty
