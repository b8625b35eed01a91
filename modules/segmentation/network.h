#pragma once

#include <filesystem>
#include <memory>
#include <vector>

namespace saker::segmentation {

/// The probability of each class at each pixel: row × column × class.
struct PixelProbabilities {
  int classes = 0, rows = 0, columns = 0;
  std::vector<float> values;

  [[nodiscard]] const float* at(std::size_t pixel) const { return &values[pixel * classes]; }
};

/// The network of tools/training/model.py, by convolutional_net.h on one thread. The image is
/// wrapped around by 16 columns at each side, so that there is no seam, and its rows are filled up
/// to a multiple of 16. One instance a thread.
class Network {
 public:
  /// `weights` are the bytes of the ONNX file; `file` is for messages. The network may tell more
  /// apart than is asked for: `class_of` has the class of each of its outputs, whose probabilities
  /// add up. Throws Error where they are not a network of that many input channels and outputs.
  Network(const std::string& weights, const std::filesystem::path& file, int channels,
          std::vector<int> class_of);
  ~Network();
  Network(Network&&) noexcept;
  Network& operator=(Network&&) noexcept;

  /// `features`: channel × row × column. The result is kept here until the next run; the caller may
  /// change it.
  PixelProbabilities& run(const std::vector<float>& features, int rows, int columns);

 private:
  struct Memory;
  void pad(const std::vector<float>& features, int rows, int columns);
  void take_row(int row, int parity);

  std::unique_ptr<Memory> memory_;
  PixelProbabilities result_;
};

}  // namespace saker::segmentation
