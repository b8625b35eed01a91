#pragma once

#include <memory>
#include <string>

namespace saker::segmentation {

/// Runs a network of convolutions, sums, rectifiers and nearest-neighbour doublings, as an ONNX
/// file holds it, by oneDNN on one thread. What follows a convolution or a doubling, a sum and a
/// rectifier, is done with it, in the memory of the other summand. One instance a thread. On
/// processors with other instructions sums are taken in another order: last digits differ.
class ConvolutionalNet {
 public:
  /// Channel × row × column, kept by the network.
  struct Planes {
    float* values = nullptr;
    int channels = 0, rows = 0, columns = 0;
  };

  /// \param onnx  the bytes of the file. Throws Error that says what else they hold.
  explicit ConvolutionalNet(const std::string& onnx);
  ~ConvolutionalNet();
  ConvolutionalNet(ConvolutionalNet&&) noexcept;
  ConvolutionalNet& operator=(ConvolutionalNet&&) noexcept;

  /// The input for an image of that size, to be filled; another size than before takes
  /// milliseconds and new memory. Throws Error where the network does not fit that size.
  [[nodiscard]] Planes input(int rows, int columns);

  /// Of the last input, filled; overwritten by the next run.
  [[nodiscard]] Planes run();

 private:
  class Graph;
  class Program;
  std::unique_ptr<Graph> graph_;
  std::unique_ptr<Program> program_;  ///< for the size of the last input
};

}  // namespace saker::segmentation
