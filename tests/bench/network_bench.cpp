// Time of the network for food on one picture of 320 x 240, beside OpenCV's dnn module with the same layers
// in floats, on one thread; and of making that picture of a frame.
#include <cstdio>
#include <memory>
#include <new>
#include <opencv2/dnn.hpp>
#include <string>
#include <vector>

#include "core/network/network_file.hpp"
#include "core/network/network_input.hpp"
#include "core/network/network_runner.hpp"
#include "tests/bench/processor_time.hpp"
#include "tests/support/network_composer.hpp"

namespace {

using namespace traygauge;

constexpr int kRounds = 25;
constexpr double kBudgetMs = 15.0;

cv::dnn::LayerParams convolution_params(const NetworkLayer& layer) {
  const std::vector<int> shape{layer.output.channels, layer.input.channels, layer.kernel, layer.kernel};
  cv::Mat weights(shape, CV_32F);
  cv::randn(weights, 0.0, 0.05);
  cv::dnn::LayerParams params;
  params.set("num_output", layer.output.channels);
  params.set("kernel_size", layer.kernel);
  params.set("stride", layer.stride);
  params.set("pad", layer.kernel / 2);
  params.set("bias_term", true);
  params.blobs = {weights, cv::Mat::zeros(layer.output.channels, 1, CV_32F)};
  return params;
}

// Layer by layer what `network` states.
class DnnNetwork {
 public:
  explicit DnnNetwork(const Network& network) : picture_({1, 3, network.height, network.width}, CV_32F) {
    cv::randu(picture_, 0.0, 1.0);
    std::vector<int> tensors{0};
    for (std::size_t i = 0; i < network.layer_count; ++i) {
      const NetworkLayer& layer = network.layers[i];
      std::vector<int> sources;
      for (const LayerSource& source : layer.used_sources()) {
        sources.push_back(enlarge(tensors[static_cast<std::size_t>(source.tensor)], source, layer));
      }
      int input = sources[0];
      if (sources.size() > 1) input = add("Concat", {}, sources);
      int output = add("Convolution", convolution_params(layer), {input});
      if (layer.has_relu) output = add("ReLU", {}, {output});
      tensors.push_back(output);
      if (layer.role != NetworkRole::none) outputs_.push_back(std::to_string(output));
    }
    net_.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    net_.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
  }

  void run() {
    net_.setInput(picture_);
    std::vector<cv::Mat> made;
    net_.forward(made, outputs_);
  }

 private:
  int add(const std::string& type, cv::dnn::LayerParams params, const std::vector<int>& inputs) {
    ++count_;
    params.name = std::to_string(count_);
    params.type = type;
    const int id = net_.addLayer(params.name, type, params);
    for (std::size_t i = 0; i < inputs.size(); ++i) net_.connect(inputs[i], 0, id, static_cast<int>(i));
    return id;
  }

  int enlarge(int from, const LayerSource& source, const NetworkLayer& layer) {
    if (source.enlargement == Enlargement::none) return from;
    cv::dnn::LayerParams params;
    params.set("interpolation", source.enlargement == Enlargement::nearest ? "nearest" : "opencv_linear");
    params.set("width", layer.input.width);
    params.set("height", layer.input.height);
    return add("Resize", params, {from});
  }

  cv::dnn::Net net_;
  cv::Mat picture_;
  std::vector<std::string> outputs_;
  int count_ = 0;
};

struct Free {
  void operator()(std::byte* block) const {
    ::operator delete (block, std::align_val_t{kArenaAlignmentBytes});
  }
};

}  // namespace

int main() {
  cv::setNumThreads(1);
  test::ComposedNetwork composed = test::food_layers();
  test::draw_numbers(1, composed);
  const std::vector<std::byte> file = test::compose_network(composed);
  Network network;
  if (parse_network(file, network) != NetworkFileStatus::ok) return 1;
  const std::size_t bytes = required_bytes(network);
  const std::unique_ptr<std::byte, Free> block(
      static_cast<std::byte*>(::operator new (bytes, std::align_val_t{kArenaAlignmentBytes})));
  NetworkRunner runner(network, {block.get(), bytes});

  cv::Mat3b frame(1200, 1600);
  cv::randu(frame, 0, 256);
  const FrameView view{frame.data, frame.cols, frame.rows, static_cast<std::ptrdiff_t>(frame.step),
                       PixelFormat::bgr8};
  const double input_ms = test::best_ms(kRounds, [&] { fill_input(view, runner.input()); });
  const double ours_ms = test::best_ms(kRounds, [&] { runner.run(); });
  DnnNetwork dnn(network);
  const double peer_ms = test::best_ms(kRounds, [&] { dnn.run(); });
  const bool is_met = ours_ms <= kBudgetMs;
  std::printf("network  %6.1f million multiply-adds  %zu bytes of memory, file %zu bytes\n",
              1e-6 * static_cast<double>(network.multiply_adds()), bytes, file.size());
  std::printf("network  %6.2f ms  OpenCV dnn in floats %6.2f ms  ratio %.2f  budget %.0f ms  %s\n", ours_ms,
              peer_ms, ours_ms / peer_ms, kBudgetMs, is_met ? "ok" : "TOO SLOW");
  std::printf("picture of a frame of 1600 x 1200  %6.2f ms\n", input_ms);
  return is_met ? 0 : 1;
}
