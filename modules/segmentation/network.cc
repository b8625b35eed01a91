#include "saker/segmentation/network.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>

#include "saker/core/error.h"
#include "saker/segmentation/blockwise.h"
#include "saker/segmentation/convolutional_net.h"

namespace saker::segmentation {
namespace {

constexpr int kWrap = 16;         // columns at each side
constexpr int kRowMultiple = 16;  // four strides of 2
constexpr int kColumnMultiple = 32;
constexpr int kTrialRows = 16, kTrialColumns = 32;  // smallest image, to see what the network gives

int filled(int n, int multiple) { return (n + multiple - 1) / multiple * multiple; }

}  // namespace

struct Network::Memory {
  ConvolutionalNet net;
  ConvolutionalNet::Planes output;
  Eigen::ArrayXXf scratch, merged;
  int classes = 0;
  std::vector<int> class_of;  ///< of each output
};

Network::~Network() = default;
Network::Network(Network&&) noexcept = default;
Network& Network::operator=(Network&&) noexcept = default;

Network::Network(const std::string& weights, const std::filesystem::path& file, int channels,
                 std::vector<int> class_of) {
  const auto outputs = static_cast<int>(class_of.size());
  const int classes = 1 + *std::max_element(class_of.begin(), class_of.end());
  try {
    memory_ = std::make_unique<Memory>(
        Memory{ConvolutionalNet(weights), {}, {}, {}, classes, std::move(class_of)});
    const ConvolutionalNet::Planes in = memory_->net.input(kTrialRows, kTrialColumns);
    if (in.channels != channels) {
      throw Error(fmt::format("{} input channels, expected {}", in.channels, channels));
    }
    std::fill_n(in.values, channels * kTrialRows * kTrialColumns, 0.0F);
    memory_->output = memory_->net.run();
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", file.string(), error.what()));
  }
  const ConvolutionalNet::Planes& out = memory_->output;
  if (out.channels != 2 * outputs || out.rows != kTrialRows || 2 * out.columns != kTrialColumns) {
    throw Error(
        fmt::format("{}: the network's output does not fit {} classes", file.string(), outputs));
  }
}

void Network::pad(const std::vector<float>& features, int rows, int columns) {
  const ConvolutionalNet::Planes in =
      memory_->net.input(filled(rows, kRowMultiple), filled(columns + 2 * kWrap, kColumnMultiple));
  const std::size_t plane = static_cast<std::size_t>(in.rows) * in.columns;
  std::fill_n(in.values, plane * in.channels, 0.0F);
  for (int channel = 0; channel < in.channels; ++channel) {
    for (int row = 0; row < rows; ++row) {
      const float* from = &features[(static_cast<std::size_t>(channel) * rows + row) * columns];
      float* to = in.values + channel * plane + static_cast<std::size_t>(row) * in.columns;
      std::copy_n(from, columns, to + kWrap);
      for (int c = 0; c < kWrap; ++c) {
        to[c] = from[(c - kWrap % columns + columns) % columns];
        to[kWrap + columns + c] = from[c % columns];
      }
    }
  }
}

PixelProbabilities& Network::run(const std::vector<float>& features, int rows, int columns) {
  pad(features, rows, columns);
  memory_->output = memory_->net.run();
  result_.classes = memory_->classes, result_.rows = rows, result_.columns = columns;
  result_.values.resize(static_cast<std::size_t>(memory_->classes) * rows * columns);
  for (int row = 0; row < rows; ++row) {
    for (const int parity : {0, 1}) take_row(row, parity);
  }
  return result_;
}

/// The head gives the scores of two columns of the image at each of its own.
void Network::take_row(int row, int parity) {
  const ConvolutionalNet::Planes& out = memory_->output;
  const int classes = memory_->classes, count = (result_.columns + 1 - parity) / 2;
  const auto outputs = static_cast<int>(memory_->class_of.size());
  const std::ptrdiff_t half = out.columns, stride = half * out.rows;
  const float* first = out.values + parity * outputs * stride + row * half + kWrap / 2;
  const Eigen::Map<const Eigen::ArrayXXf, 0, Eigen::OuterStride<>> scores(
      first, count, outputs, Eigen::OuterStride<>(stride));
  Eigen::ArrayXXf& scratch = memory_->scratch;
  scratch = scores;
  scratch.colwise() -= scores.rowwise().maxCoeff();
  for_each_block(scratch.data(), static_cast<std::size_t>(scratch.size()),
                 [](Block& v) { v = v.exp(); });
  Eigen::ArrayXXf& merged = memory_->merged;
  merged.setZero(count, classes);
  for (int k = 0; k < outputs; ++k) merged.col(memory_->class_of[k]) += scratch.col(k);
  const std::size_t begin = static_cast<std::size_t>(row) * result_.columns + parity;
  Eigen::Map<Eigen::ArrayXXf, 0, Eigen::OuterStride<>> probabilities(
      &result_.values[begin * classes], classes, count, Eigen::OuterStride<>(2 * classes));
  probabilities = (merged.colwise() / merged.rowwise().sum()).transpose();
}

}  // namespace saker::segmentation
