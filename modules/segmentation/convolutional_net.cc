#include "saker/segmentation/convolutional_net.h"

#include <fmt/format.h>
#include <omp.h>
#define ONNX_ML 1  // as Debian builds it
#include <onnx/onnx_pb.h>

#include <cstring>
#include <dnnl.hpp>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <vector>

#include "saker/core/error.h"

namespace saker::segmentation {
namespace {

using Descriptor = dnnl::memory::desc;
using Layout = dnnl::memory::format_tag;
using Sizes = dnnl::memory::dims;

constexpr auto kFloat = dnnl::memory::data_type::f32;

Error unfit(const onnx::NodeProto& node, const std::string& expected) {
  return Error(
      fmt::format("{} \"{}\" in the network, expected {}", node.op_type(), node.name(), expected));
}

std::vector<float> floats_of(const onnx::TensorProto& tensor) {
  constexpr std::size_t kMost = std::size_t{1} << 26U;
  std::size_t count = 1;
  for (const std::int64_t size : tensor.dims()) {
    const bool fits = size >= 0 && static_cast<std::size_t>(size) <= kMost;
    count = fits ? count * static_cast<std::size_t>(size) : kMost + 1;
    if (count > kMost) throw Error(fmt::format("tensor \"{}\" of impossible size", tensor.name()));
  }
  std::vector<float> values(tensor.float_data().begin(), tensor.float_data().end());
  const std::string& raw = tensor.raw_data();
  if (!raw.empty() && raw.size() % sizeof(float) == 0) {
    values.resize(raw.size() / sizeof(float));
    std::memcpy(values.data(), raw.data(), raw.size());
  }
  if (tensor.data_type() != onnx::TensorProto::FLOAT || values.size() != count) {
    throw Error(
        fmt::format("tensor \"{}\" in the network, expected {} floats", tensor.name(), count));
  }
  return values;
}

const onnx::AttributeProto* attribute(const onnx::NodeProto& node, const std::string& name) {
  for (const onnx::AttributeProto& a : node.attribute()) {
    if (a.name() == name) return &a;
  }
  return nullptr;
}

Sizes integers(const onnx::NodeProto& node, const std::string& name, const Sizes& otherwise) {
  const onnx::AttributeProto* a = attribute(node, name);
  if (a == nullptr) return otherwise;
  Sizes values(a->ints().begin(), a->ints().end());
  if (values.size() != otherwise.size())
    throw unfit(node, fmt::format("{} {}", otherwise.size(), name));
  return values;
}

}  // namespace

/// What the file holds.
class ConvolutionalNet::Graph {
 public:
  explicit Graph(const std::string& bytes) {
    if (!model_.ParseFromString(bytes) || nodes().empty()) throw Error("no ONNX file");
    for (const onnx::TensorProto& t : model_.graph().initializer()) constants_[t.name()] = &t;
    for (const onnx::NodeProto& node : nodes()) {
      if (node.output_size() != 1) throw unfit(node, "one output");
      const onnx::AttributeProto* value = attribute(node, "value");
      if (node.op_type() == "Constant" && value != nullptr) {
        constants_[node.output(0)] = &value->t();
      }
    }
    if (model_.graph().input_size() != 1 || model_.graph().output_size() != 1) {
      throw Error("a network of several inputs or outputs");
    }
  }

  using Nodes = google::protobuf::RepeatedPtrField<onnx::NodeProto>;
  [[nodiscard]] const Nodes& nodes() const { return model_.graph().node(); }
  [[nodiscard]] const std::string& input() const { return model_.graph().input(0).name(); }
  [[nodiscard]] const std::string& output() const { return model_.graph().output(0).name(); }

  [[nodiscard]] const onnx::TensorProto& constant(const onnx::NodeProto& node, int input) const {
    const auto found =
        input < node.input_size() ? constants_.find(node.input(input)) : constants_.end();
    if (found == constants_.end()) throw unfit(node, "constants");
    return *found->second;
  }

  /// Places in the order of execution.
  [[nodiscard]] std::vector<int> users(const std::string& tensor) const {
    std::vector<int> users;
    for (int i = 0; i < nodes().size(); ++i) {
      const auto& inputs = nodes()[i].input();
      if (std::find(inputs.begin(), inputs.end(), tensor) != inputs.end()) users.push_back(i);
    }
    return users;
  }

  [[nodiscard]] int channels() const {
    for (const onnx::NodeProto& node : nodes()) {
      if (node.op_type() != "Conv" || node.input_size() < 1 || node.input(0) != input()) continue;
      const onnx::TensorProto& weights = constant(node, 1);
      if (weights.dims_size() == 4 && weights.dims(1) <= 1 << 10) {
        return static_cast<int>(weights.dims(1));
      }
    }
    throw Error("a network that begins with no convolution");
  }

 private:
  onnx::ModelProto model_;
  std::map<std::string, const onnx::TensorProto*> constants_;
};

/// The graph as a sequence of oneDNN's primitives for one size of image.
class ConvolutionalNet::Program {
 public:
  Program(const Graph& graph, int rows, int columns) : graph_(graph) {
    omp_set_num_threads(1);  // oneDNN's weights are laid out for as many
    const Sizes size = {1, graph.channels(), rows, columns};
    input_ = dnnl::memory(Descriptor(size, kFloat, Layout::nchw), engine_);
    tensors_[graph.input()] = input_;
    for (int i = 0; i < graph.nodes().size(); ++i) {
      if (done_.count(i) == 0) add(i);
    }
    const dnnl::memory result = tensor(graph.output());
    output_ = laid_out(result, Descriptor(result.get_desc().dims(), kFloat, Layout::nchw));
    tensors_.clear();
  }

  Planes input() { return planes(input_); }

  Planes run() {
    omp_set_num_threads(1);  // of the calling thread
    for (Step& step : steps_) step.primitive.execute(stream_, step.arguments);
    stream_.wait();
    return planes(output_);
  }

 private:
  struct Step {
    dnnl::primitive primitive;
    std::unordered_map<int, dnnl::memory> arguments;
  };

  /// What is done with a node, on its result.
  struct Fused {
    dnnl::primitive_attr attributes;
    std::optional<dnnl::memory> summand;  ///< in whose memory the result is left
    std::string output;                   ///< name of the tensor

    [[nodiscard]] Descriptor result(const Sizes& size) const {
      if (!summand) return {size, kFloat, Layout::any};
      if (summand->get_desc().dims() != size) throw Error("a sum of tensors of different sizes");
      return summand->get_desc();
    }
  };

  static Planes planes(const dnnl::memory& memory) {
    const Sizes size = memory.get_desc().dims();
    return {static_cast<float*>(memory.get_data_handle()), static_cast<int>(size[1]),
            static_cast<int>(size[2]), static_cast<int>(size[3])};
  }

  const dnnl::memory& tensor(const std::string& name) const {
    const auto found = tensors_.find(name);
    if (found == tensors_.end()) throw Error("tensor \"" + name + "\" comes from nowhere");
    return found->second;
  }

  void add(int i) {
    const onnx::NodeProto& node = graph_.nodes()[i];
    if (node.op_type() == "Constant") return;
    if (node.input_size() < 1) throw unfit(node, "an input");
    if (node.op_type() == "Conv") {
      add_convolution(node, fuse(i));
    } else if (node.op_type() == "Resize") {
      add_doubling(node, fuse(i));
    } else {
      throw unfit(node, "convolutions and doublings, each with a sum and a rectifier after it");
    }
  }

  Fused fuse(int first) {
    dnnl::post_ops after;
    Fused fused;
    fused.output = graph_.nodes()[first].output(0);
    for (;;) {
      const std::vector<int> users = graph_.users(fused.output);
      if (users.size() != 1) break;
      const onnx::NodeProto& next = graph_.nodes()[users[0]];
      const bool rectifier = next.op_type() == "Relu";
      if (rectifier) {
        after.append_eltwise(1, dnnl::algorithm::eltwise_relu, 0, 0);
      } else if (next.op_type() == "Add" && next.input_size() == 2 && !fused.summand) {
        const std::string& other = next.input(next.input(0) == fused.output ? 1 : 0);
        if (!free_after(other, first, users[0])) break;
        fused.summand = tensor(other);
        after.append_sum(1);
      } else {
        break;
      }
      done_.insert(users[0]);
      fused.output = next.output(0);
      if (rectifier) break;
    }
    fused.attributes.set_post_ops(after);
    return fused;
  }

  /// Whether nothing but `sum` reads the tensor from `first` on.
  bool free_after(const std::string& name, int first, int sum) const {
    const bool outside = name == graph_.input() || name == graph_.output();
    if (tensors_.count(name) == 0 || outside) return false;
    for (const int user : graph_.users(name)) {
      if (user >= first && user != sum) return false;
    }
    return true;
  }

  void add_convolution(const onnx::NodeProto& node, const Fused& fused) {
    const onnx::TensorProto& kernel = graph_.constant(node, 1);
    const Sizes stride = integers(node, "strides", {1, 1});
    const Sizes pad = integers(node, "pads", {0, 0, 0, 0});
    const onnx::AttributeProto* group = attribute(node, "group");
    if (kernel.dims_size() != 4 || (group != nullptr && group->i() != 1) ||
        integers(node, "dilations", {1, 1}) != Sizes{1, 1} || stride[0] < 1 || stride[1] < 1) {
      throw unfit(node, "a plain convolution of images");
    }
    const Sizes shape(kernel.dims().begin(), kernel.dims().end());
    const Sizes from = tensor(node.input(0)).get_desc().dims();
    const Sizes to = {1, shape[0], (from[2] + pad[0] + pad[2] - shape[2]) / stride[0] + 1,
                      (from[3] + pad[1] + pad[3] - shape[3]) / stride[1] + 1};
    const Descriptor bias({shape[0]}, kFloat, Layout::x);
    const dnnl::convolution_forward::primitive_desc chosen({dnnl::prop_kind::forward_inference,
                                                            dnnl::algorithm::convolution_direct,
                                                            Descriptor(from, kFloat, Layout::any),
                                                            Descriptor(shape, kFloat, Layout::any),
                                                            bias,
                                                            fused.result(to),
                                                            stride,
                                                            {pad[0], pad[1]},
                                                            {pad[2], pad[3]}},
                                                           fused.attributes, engine_);
    const dnnl::memory input = laid_out(tensor(node.input(0)), chosen.src_desc());
    dnnl::memory weights = filled(Descriptor(shape, kFloat, Layout::oihw), floats_of(kernel));
    dnnl::memory kept(chosen.weights_desc(), engine_);
    dnnl::reorder(weights, kept).execute(stream_, weights, kept);
    stream_.wait();
    finish(dnnl::convolution_forward(chosen), chosen.dst_desc(), fused,
           {{DNNL_ARG_SRC, input},
            {DNNL_ARG_WEIGHTS, kept},
            {DNNL_ARG_BIAS, filled(bias, bias_of(node, shape[0]))}});
  }

  std::vector<float> bias_of(const onnx::NodeProto& node, std::int64_t channels) const {
    const bool stated = node.input_size() > 2 && !node.input(2).empty();
    return stated ? floats_of(graph_.constant(node, 2))
                  : std::vector<float>(static_cast<std::size_t>(channels), 0.0F);
  }

  void add_doubling(const onnx::NodeProto& node, const Fused& fused) {
    const onnx::AttributeProto* mode = attribute(node, "mode");
    const onnx::AttributeProto* place = attribute(node, "coordinate_transformation_mode");
    const onnx::AttributeProto* nearest = attribute(node, "nearest_mode");
    if (mode == nullptr || mode->s() != "nearest" || place == nullptr ||
        place->s() != "asymmetric" || nearest == nullptr || nearest->s() != "floor" ||
        floats_of(graph_.constant(node, 2)) != std::vector<float>{1, 1, 2, 2}) {
      throw unfit(node, "each pixel twice in both directions");
    }
    const dnnl::memory input = tensor(node.input(0));
    const Sizes from = input.get_desc().dims();
    const dnnl::resampling_forward::primitive_desc chosen(
        {dnnl::prop_kind::forward_inference, dnnl::algorithm::resampling_nearest, input.get_desc(),
         fused.result({1, from[1], 2 * from[2], 2 * from[3]})},
        fused.attributes, engine_);
    finish(dnnl::resampling_forward(chosen), chosen.dst_desc(), fused, {{DNNL_ARG_SRC, input}});
  }

  void finish(dnnl::primitive primitive, const Descriptor& result, const Fused& fused,
              std::unordered_map<int, dnnl::memory> arguments) {
    const dnnl::memory output = fused.summand ? *fused.summand : dnnl::memory(result, engine_);
    arguments[DNNL_ARG_DST] = output;
    steps_.push_back({std::move(primitive), std::move(arguments)});
    tensors_[fused.output] = output;
  }

  dnnl::memory filled(const Descriptor& descriptor, const std::vector<float>& values) {
    dnnl::memory memory(descriptor, engine_);
    if (descriptor.get_size() != values.size() * sizeof(float))
      throw Error("constants of another size");
    std::copy(values.begin(), values.end(), static_cast<float*>(memory.get_data_handle()));
    return memory;
  }

  dnnl::memory laid_out(const dnnl::memory& memory, const Descriptor& wanted) {
    if (memory.get_desc() == wanted) return memory;
    const dnnl::memory other(wanted, engine_);
    steps_.push_back(
        {dnnl::reorder(memory, other), {{DNNL_ARG_FROM, memory}, {DNNL_ARG_TO, other}}});
    return other;
  }

  const Graph& graph_;
  dnnl::engine engine_{dnnl::engine::kind::cpu, 0};
  dnnl::stream stream_{engine_};
  std::map<std::string, dnnl::memory> tensors_;
  std::set<int> done_;
  std::vector<Step> steps_;
  dnnl::memory input_, output_;
};

ConvolutionalNet::ConvolutionalNet(const std::string& onnx)
    : graph_(std::make_unique<Graph>(onnx)) {}

ConvolutionalNet::~ConvolutionalNet() = default;
ConvolutionalNet::ConvolutionalNet(ConvolutionalNet&&) noexcept = default;
ConvolutionalNet& ConvolutionalNet::operator=(ConvolutionalNet&&) noexcept = default;

ConvolutionalNet::Planes ConvolutionalNet::input(int rows, int columns) {
  const Planes last = program_ ? program_->input() : Planes{};
  if (last.rows != rows || last.columns != columns) {
    program_.reset();
    try {
      program_ = std::make_unique<Program>(*graph_, rows, columns);
    } catch (const dnnl::error& error) {
      throw Error(fmt::format("no network for an image of {} rows and {} columns: {}", rows,
                              columns, error.what()));
    }
  }
  return program_->input();
}

ConvolutionalNet::Planes ConvolutionalNet::run() { return program_->run(); }

}  // namespace saker::segmentation
