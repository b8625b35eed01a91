#include "saker/segmentation/convolutional_net.h"

#include <gtest/gtest.h>
#define ONNX_ML 1
#include <onnx/onnx_pb.h>

#include <algorithm>
#include <numeric>

#include "saker/core/error.h"

namespace saker::segmentation {
namespace {

/// A network in the making: tensors are named, "in" comes first.
class MadeNet {
 public:
  MadeNet() { model_.mutable_graph()->add_input()->set_name("in"); }

  void constant(const std::string& name, const std::vector<std::int64_t>& sizes,
                const std::vector<float>& values) {
    onnx::TensorProto& t = *model_.mutable_graph()->add_initializer();
    t.set_name(name);
    t.set_data_type(onnx::TensorProto::FLOAT);
    for (const std::int64_t size : sizes) t.add_dims(size);
    for (const float value : values) t.add_float_data(value);
  }

  onnx::NodeProto& node(const std::string& kind, const std::vector<std::string>& inputs,
                        const std::string& output) {
    onnx::NodeProto& n = *model_.mutable_graph()->add_node();
    n.set_op_type(kind);
    for (const std::string& input : inputs) n.add_input(input);
    n.add_output(output);
    return n;
  }

  /// One channel, 3×3, the same size: `kernel` times what is around a pixel.
  void convolution(const std::string& from, const std::vector<float>& kernel, float bias,
                   const std::string& to) {
    constant(to + ".k", {1, 1, 3, 3}, kernel);
    constant(to + ".b", {1}, {bias});
    integers(node("Conv", {from, to + ".k", to + ".b"}, to), "pads", {1, 1, 1, 1});
  }

  void doubling(const std::string& from, const std::string& to, const std::string& mode) {
    constant(to + ".s", {4}, {1, 1, 2, 2});
    onnx::NodeProto& n = node("Resize", {from, "", to + ".s"}, to);
    word(n, "mode", mode);
    word(n, "coordinate_transformation_mode", "asymmetric");
    word(n, "nearest_mode", "floor");
  }

  static void integers(onnx::NodeProto& n, const std::string& name,
                       const std::vector<std::int64_t>& values) {
    onnx::AttributeProto& a = *n.add_attribute();
    a.set_name(name);
    for (const std::int64_t value : values) a.add_ints(value);
  }

  std::string bytes(const std::string& output) {
    model_.mutable_graph()->clear_output();
    model_.mutable_graph()->add_output()->set_name(output);
    return model_.SerializeAsString();
  }

 private:
  static void word(onnx::NodeProto& n, const std::string& name, const std::string& value) {
    onnx::AttributeProto& a = *n.add_attribute();
    a.set_name(name);
    a.set_s(value);
  }

  onnx::ModelProto model_;
};

const std::vector<float> kItself = {0, 0, 0, 0, 1, 0, 0, 0, 0};
const std::vector<float> kLeft = {0, 0, 0, 1, 0, 0, 0, 0, 0};

/// Of an image 2 × 4 that counts 1, 2, …, 8.
std::vector<float> result(const std::string& bytes) {
  ConvolutionalNet net(bytes);
  const ConvolutionalNet::Planes in = net.input(2, 4);
  std::iota(in.values, in.values + 8, 1.0F);
  const ConvolutionalNet::Planes out = net.run();
  return {out.values,
          out.values + static_cast<std::ptrdiff_t>(out.channels) * out.rows * out.columns};
}

TEST(ConvolutionalNet, ConvolvesWithNothingBeyondTheEdge) {
  MadeNet net;
  net.convolution("in", kLeft, 0.5F, "out");
  EXPECT_EQ(result(net.bytes("out")),
            (std::vector<float>{0.5F, 1.5F, 2.5F, 3.5F, 0.5F, 5.5F, 6.5F, 7.5F}));
}

TEST(ConvolutionalNet, RectifiesAfterASum) {
  MadeNet net;
  net.convolution("in", kItself, -4, "a");
  net.convolution("a", kItself, 0, "between");
  net.convolution("between", kItself, 0, "b");
  net.node("Add", {"a", "b"}, "sum");
  net.node("Relu", {"sum"}, "out");
  EXPECT_EQ(result(net.bytes("out")), (std::vector<float>{0, 0, 0, 0, 2, 4, 6, 8}));
}

TEST(ConvolutionalNet, DoublesAndAddsWhatWasThereBefore) {
  MadeNet net;
  net.convolution("in", kItself, 0, "fine");
  net.constant("k", {1, 1, 1, 1}, {1});
  net.constant("b", {1}, {0});
  MadeNet::integers(net.node("Conv", {"fine", "k", "b"}, "coarse"), "strides", {2, 2});
  net.doubling("coarse", "again", "nearest");
  net.node("Add", {"fine", "again"}, "out");
  EXPECT_EQ(result(net.bytes("out")), (std::vector<float>{2, 3, 6, 7, 6, 7, 10, 11}));
}

TEST(ConvolutionalNet, NeedsNoBias) {
  MadeNet net;
  net.constant("k", {1, 1, 1, 1}, {2});
  net.node("Conv", {"in", "k"}, "out");
  EXPECT_EQ(result(net.bytes("out")), (std::vector<float>{2, 4, 6, 8, 10, 12, 14, 16}));
}

TEST(ConvolutionalNet, KnowsTheInputsChannels) {
  MadeNet net;
  net.constant("k", {1, 3, 1, 1}, {1, 1, 1});
  net.constant("b", {1}, {0});
  net.node("Conv", {"in", "k", "b"}, "out");
  ConvolutionalNet found(net.bytes("out"));
  EXPECT_EQ(found.input(4, 8).channels, 3);
}

TEST(ConvolutionalNet, GivesTheSameBytesAfterAnotherSize) {
  MadeNet net;
  net.convolution("in", std::vector<float>(9, 0.1F), 0, "out");
  ConvolutionalNet found(net.bytes("out"));
  auto run = [&](int rows, int columns) {
    const ConvolutionalNet::Planes in = found.input(rows, columns);
    const std::ptrdiff_t size = static_cast<std::ptrdiff_t>(rows) * columns;
    std::iota(in.values, in.values + size, 0.0F);
    const ConvolutionalNet::Planes out = found.run();
    return std::vector<float>(out.values, out.values + size);
  };
  const std::vector<float> first = run(16, 32);
  (void)run(8, 8);
  EXPECT_EQ(run(16, 32), first);
}

/// Its memory is read later, too.
TEST(ConvolutionalNet, RefusesASumThatItCannotTakeInPlace) {
  MadeNet net;
  net.convolution("in", kItself, 0, "a");
  net.convolution("a", kItself, 0, "b");
  net.node("Add", {"a", "b"}, "c");
  net.convolution("a", kItself, 0, "d");
  net.node("Add", {"c", "d"}, "out");
  EXPECT_THROW(result(net.bytes("out")), Error);
}

TEST(ConvolutionalNet, RefusesWhatItDoesNotKnow) {
  MadeNet pool;
  pool.convolution("in", kItself, 0, "a");
  pool.node("MaxPool", {"a"}, "out");
  EXPECT_THROW(result(pool.bytes("out")), Error);
  MadeNet linear;
  linear.convolution("in", kItself, 0, "a");
  linear.doubling("a", "out", "linear");
  EXPECT_THROW(result(linear.bytes("out")), Error);
  MadeNet grouped;
  grouped.convolution("in", kItself, 0, "a");
  grouped.constant("k", {1, 1, 1}, {1});
  grouped.node("Conv", {"a", "k", "a.b"}, "out");
  EXPECT_THROW(result(grouped.bytes("out")), Error);
}

TEST(ConvolutionalNet, RefusesTensorsThatComeFromNowhereOrHaveAnotherSize) {
  MadeNet lost;
  lost.convolution("in", kItself, 0, "a");
  lost.convolution("elsewhere", kItself, 0, "out");
  EXPECT_THROW(result(lost.bytes("out")), Error);
  EXPECT_THROW(result(lost.bytes("nowhere")), Error);
  MadeNet alone;
  alone.node("Conv", {}, "out");
  EXPECT_THROW(result(alone.bytes("out")), Error);
  MadeNet huge;
  huge.constant("out.k", {1 << 30, 1 << 30, 1 << 30, 16}, {});
  huge.node("Conv", {"in", "out.k"}, "out");
  EXPECT_THROW(result(huge.bytes("out")), Error);
  MadeNet few;
  few.convolution("in", {1, 2, 3}, 0, "out");
  EXPECT_THROW(result(few.bytes("out")), Error);
}

TEST(ConvolutionalNet, RefusesAnImageThatItsSumsDoNotFit) {
  MadeNet net;
  net.convolution("in", kItself, 0, "fine");
  net.constant("k", {1, 1, 1, 1}, {1});
  net.constant("b", {1}, {0});
  MadeNet::integers(net.node("Conv", {"fine", "k", "b"}, "coarse"), "strides", {2, 2});
  net.doubling("coarse", "again", "nearest");
  net.node("Add", {"fine", "again"}, "out");
  ConvolutionalNet found(net.bytes("out"));
  EXPECT_THROW((void)found.input(3, 4), Error);
}

}  // namespace
}  // namespace saker::segmentation
