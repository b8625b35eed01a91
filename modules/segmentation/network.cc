#include "segmentation/network.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/dnn.hpp>

#include "core/error.h"

namespace saker::segmentation {
namespace {

constexpr int kWrap = 16;        // columns at each side
constexpr int kRowMultiple = 8;  // three strides of 2
constexpr int kColumnMultiple = 16;
constexpr int kTrialRows = 8, kTrialColumns = 32;  // smallest image, to see what the network gives

int filled(int n, int multiple) { return (n + multiple - 1) / multiple * multiple; }

/// Softmax over the classes of one pixel, whose scores lie `stride` apart.
void softmax(const float* score, std::size_t stride, int classes, float* out,
             std::size_t out_stride) {
  float highest = score[0], sum = 0;
  for (int k = 1; k < classes; ++k) highest = std::max(highest, score[k * stride]);
  for (int k = 0; k < classes; ++k) {
    const float e = std::exp(score[k * stride] - highest);
    out[k * out_stride] = e;
    sum += e;
  }
  for (int k = 0; k < classes; ++k) out[k * out_stride] /= sum;
}

}  // namespace

struct Network::Memory {
  cv::dnn::Net net;
  cv::Mat input, output;
  int channels = 0, classes = 0;
};

Network::~Network() = default;
Network::Network(Network&&) noexcept = default;
Network& Network::operator=(Network&&) noexcept = default;

Network::Network(const std::string& weights, const std::filesystem::path& file, int channels,
                 int classes)
    : memory_(std::make_unique<Memory>()) {
  memory_->channels = channels;
  memory_->classes = classes;
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
  if (out.dims != 4 || out.size[1] != 2 * classes || out.size[2] != kTrialRows ||
      out.size[3] != memory_->input.size[3] / 2) {
    throw Error(file.string() + ": the network's output does not fit " + std::to_string(classes) +
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
      for (int c = 0; c < columns + 2 * kWrap; ++c) {
        to[c] = from[(c - kWrap % columns + columns) % columns];
      }
    }
  }
}

const PixelProbabilities& Network::run(const std::vector<float>& features, int rows, int columns) {
  pad(features, rows, columns);
  memory_->net.setInput(memory_->input);
  memory_->output = memory_->net.forward();
  const cv::Mat& out = memory_->output;
  const int classes = memory_->classes;
  const std::size_t half = out.size[3], stride = half * out.size[2];
  const std::size_t pixels = static_cast<std::size_t>(rows) * columns;
  result_.classes = classes, result_.rows = rows, result_.columns = columns;
  result_.values.resize(classes * pixels);
  const float* scores = out.ptr<float>();
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const int c = column + kWrap;  // the head gives two columns' scores at each of its own
      const float* score = scores + (c % 2) * classes * stride + row * half + c / 2;
      float* probability = &result_.values[static_cast<std::size_t>(row) * columns + column];
      softmax(score, stride, classes, probability, pixels);
    }
  }
  return result_;
}

}  // namespace saker::segmentation
