#include "saker/segmentation/network.h"

#include <Eigen/Core>
#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/dnn.hpp>

#include "saker/core/error.h"

namespace saker::segmentation {
namespace {

constexpr int kWrap = 16;         // columns at each side
constexpr int kRowMultiple = 16;  // four strides of 2
constexpr int kColumnMultiple = 32;
constexpr int kTrialRows = 16, kTrialColumns = 32;  // smallest image, to see what the network gives

int filled(int n, int multiple) { return (n + multiple - 1) / multiple * multiple; }

}  // namespace

struct Network::Memory {
  cv::dnn::Net net;
  cv::Mat input, output;
  Eigen::ArrayXXf scratch, merged;
  int channels = 0, classes = 0;
  std::vector<int> class_of;  ///< of each output
};

Network::~Network() = default;
Network::Network(Network&&) noexcept = default;
Network& Network::operator=(Network&&) noexcept = default;

Network::Network(const std::string& weights, const std::filesystem::path& file, int channels,
                 std::vector<int> class_of)
    : memory_(std::make_unique<Memory>()) {
  memory_->channels = channels;
  memory_->class_of = std::move(class_of);
  memory_->classes = 1 + *std::max_element(memory_->class_of.begin(), memory_->class_of.end());
  const auto outputs = static_cast<int>(memory_->class_of.size());
  cv::setNumThreads(1);
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);  // Error says it
  try {
    memory_->net = cv::dnn::readNetFromONNX(weights.data(), weights.size());
    pad(std::vector<float>(static_cast<std::size_t>(channels) * kTrialRows * kTrialColumns),
        kTrialRows, kTrialColumns);
    memory_->net.setInput(memory_->input);
    memory_->output = memory_->net.forward();
  } catch (const cv::Exception&) {
    throw Error(file.string() + ": not an ONNX network of " + std::to_string(channels) +
                " input channels");
  }
  const cv::Mat& out = memory_->output;
  if (out.dims != 4 || out.size[1] != 2 * outputs || out.size[2] != kTrialRows ||
      out.size[3] != memory_->input.size[3] / 2) {
    throw Error(file.string() + ": the network's output does not fit " + std::to_string(outputs) +
                " classes");
  }
}

void Network::pad(const std::vector<float>& features, int rows, int columns) {
  const int channels = memory_->channels;
  const int padded_rows = filled(rows, kRowMultiple);
  const int padded_columns = filled(columns + 2 * kWrap, kColumnMultiple);
  const int size[] = {1, channels, padded_rows, padded_columns};
  memory_->input.create(4, size, CV_32F);
  memory_->input.setTo(0);
  for (int channel = 0; channel < channels; ++channel) {
    for (int row = 0; row < rows; ++row) {
      const float* from = &features[(static_cast<std::size_t>(channel) * rows + row) * columns];
      float* to =
          memory_->input.ptr<float>(0, channel) + static_cast<std::size_t>(row) * padded_columns;
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
  memory_->net.setInput(memory_->input);
  memory_->output = memory_->net.forward();
  result_.classes = memory_->classes, result_.rows = rows, result_.columns = columns;
  result_.values.resize(static_cast<std::size_t>(memory_->classes) * rows * columns);
  for (int row = 0; row < rows; ++row) {
    for (const int parity : {0, 1}) take_row(row, parity);
  }
  return result_;
}

/// The head gives the scores of two columns of the image at each of its own.
void Network::take_row(int row, int parity) {
  const cv::Mat& out = memory_->output;
  const int classes = memory_->classes, count = (result_.columns + 1 - parity) / 2;
  const auto outputs = static_cast<int>(memory_->class_of.size());
  const std::ptrdiff_t half = out.size[3], stride = half * out.size[2];
  const float* first = out.ptr<float>() + parity * outputs * stride + row * half + kWrap / 2;
  const Eigen::Map<const Eigen::ArrayXXf, 0, Eigen::OuterStride<>> scores(
      first, count, outputs, Eigen::OuterStride<>(stride));
  Eigen::ArrayXXf& scratch = memory_->scratch;
  scratch = (scores.colwise() - scores.rowwise().maxCoeff()).exp();
  Eigen::ArrayXXf& merged = memory_->merged;
  merged.setZero(count, classes);
  for (int k = 0; k < outputs; ++k) merged.col(memory_->class_of[k]) += scratch.col(k);
  const std::size_t begin = static_cast<std::size_t>(row) * result_.columns + parity;
  Eigen::Map<Eigen::ArrayXXf, 0, Eigen::OuterStride<>> probabilities(
      &result_.values[begin * classes], classes, count, Eigen::OuterStride<>(2 * classes));
  probabilities = (merged.colwise() / merged.rowwise().sum()).transpose();
}

}  // namespace saker::segmentation
