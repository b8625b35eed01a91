#include "saker/segmentation/network.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "paths.h"
#include "saker/core/error.h"
#include "saker/segmentation/features.h"

namespace saker::segmentation {
namespace {

const std::string kFolder = source_dir() + "/tests/segmentation/small/";

std::string bytes_of(const std::string& file) {
  std::ifstream stream(kFolder + file, std::ios::binary);
  EXPECT_TRUE(stream) << file;
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<float> floats_of(const std::string& file) {
  const std::string bytes = bytes_of(file);
  std::vector<float> values(bytes.size() / sizeof(float));
  std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(values.data()));
  return values;
}

constexpr int kRows = 10, kColumns = 64, kClasses = 5;
const std::vector<int> kClassOf = {0, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 2, 3, 4};  // as labels.py

/// A small network of the same kind with weights at random, its input and what PyTorch makes of it
/// (tools/training/small_network.py).
class SmallNetwork : public ::testing::Test {
 protected:
  Network network_{bytes_of("network.onnx"), "network.onnx", kChannelCount, kClassOf};
  std::vector<float> features_ = floats_of("features.f32");
};

TEST_F(SmallNetwork, GivesWhatPyTorchGives) {
  const std::vector<float> expected = floats_of("probabilities.f32");
  const PixelProbabilities& found = network_.run(features_, kRows, kColumns);
  ASSERT_EQ(found.values.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) ASSERT_NEAR(found.values[i], expected[i], 1e-3);
}

TEST_F(SmallNetwork, GivesTheSameBytesTwiceAndAfterAnotherSize) {
  const std::vector<float> first = network_.run(features_, kRows, kColumns).values;
  (void)network_.run(std::vector<float>(kChannelCount * 16 * 96, 0.5F), 16, 96);
  EXPECT_EQ(network_.run(features_, kRows, kColumns).values, first);
}

TEST_F(SmallNetwork, HasNoSeam) {
  const std::vector<float> straight = network_.run(features_, kRows, kColumns).values;
  constexpr int kTurn = 32;  // a multiple of the network's strides
  std::vector<float> turned(features_.size());
  auto from = [](std::size_t i) {  // of a pixel of any row
    return i / kColumns * kColumns + (i % kColumns + kTurn) % kColumns;
  };
  for (std::size_t i = 0; i < turned.size(); ++i) turned[i] = features_[from(i)];
  const std::vector<float> found = network_.run(turned, kRows, kColumns).values;
  double difference = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const std::size_t pixel = i / kClasses, k = i % kClasses;
    difference += std::abs(found[i] - straight[from(pixel) * kClasses + k]);
  }
  EXPECT_LT(difference / static_cast<double>(found.size()), 0.01);
}

TEST(Network, RefusesWhatIsNoNetworkOfTheRightShape) {
  const std::string good = bytes_of("network.onnx");
  EXPECT_THROW(Network("not a network", "x.onnx", kChannelCount, kClassOf), Error);
  EXPECT_THROW(Network("", "x.onnx", kChannelCount, kClassOf), Error);
  EXPECT_THROW(Network(good.substr(0, good.size() / 2), "x.onnx", kChannelCount, kClassOf), Error);
  EXPECT_THROW(Network(good, "x.onnx", kChannelCount, {0, 1, 2}), Error);
  EXPECT_THROW(Network(good, "x.onnx", kChannelCount + 1, kClassOf), Error);
}

}  // namespace
}  // namespace saker::segmentation
