#include "firmware/network/network_command.hpp"

#include <array>
#include <cstdio>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <ostream>
#include <sstream>

#include "core/network/network_file.hpp"
#include "core/network/network_runner.hpp"
#include "firmware/base/aligned_block.hpp"
#include "firmware/base/exit_status.hpp"
#include "firmware/base/percent.hpp"
#include "firmware/base/text.hpp"
#include "firmware/command/program.hpp"
#include "firmware/network/loaded_network.hpp"
#include "firmware/network/network_sheet.hpp"
#include "simulator/capture/picture_file.hpp"
#include "simulator/capture/png_writer.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kNameWidth = kNetworkNameBytes + 2;

const char* role_text(NetworkRole role) {
  constexpr std::array<const char*, kNetworkRoles> kTexts = {"", "classes", "border", "embedding"};
  return kTexts[static_cast<std::size_t>(role)];
}

std::string shape_text(const TensorShape& shape) {
  return std::to_string(shape.width) + " x " + std::to_string(shape.height) + " x " +
         std::to_string(shape.channels);
}

// "12 bilinear + 1": tensors, and how they are enlarged.
std::string sources_text(const NetworkLayer& layer) {
  constexpr std::array<const char*, kEnlargements> kTexts = {"", " nearest", " bilinear"};
  std::string text;
  for (const LayerSource& source : layer.used_sources()) {
    if (!text.empty()) text += " + ";
    text += std::to_string(source.tensor);
    text += kTexts[static_cast<std::size_t>(source.enlargement)];
  }
  return text;
}

// "3 x 3, stride 2, ReLU".
std::string convolution_text(const NetworkLayer& layer) {
  std::string text = std::to_string(layer.kernel);
  text += " x ";
  text += std::to_string(layer.kernel);
  text += ", stride ";
  text += std::to_string(layer.stride);
  if (layer.has_relu) text += ", ReLU";
  return text;
}

void print_layers(const Network& network, std::ostream& out) {
  out << pad_left("tensor", 6) << "  " << pad_right("of tensors", 20) << pad_right("convolution", 24)
      << pad_right("size", 18) << "role\n";
  out << pad_left("0", 6) << "  " << pad_right("", 44) << shape_text(network.tensor_shape(0)) << "\n";
  for (std::size_t i = 0; i < network.layer_count; ++i) {
    const NetworkLayer& layer = network.layers[i];
    const std::string role = role_text(layer.role);
    out << pad_left(std::to_string(i + 1), 6) << "  " << pad_right(sources_text(layer), 20)
        << pad_right(convolution_text(layer), 24)
        << (role.empty() ? shape_text(layer.output) : pad_right(shape_text(layer.output), 18) + role) << "\n";
  }
}

std::size_t count_weights(const Network& network) {
  std::size_t weights = 0;
  for (const NetworkLayer& layer : network.used_layers()) weights += layer.weights.size();
  return weights;
}

void print_file(const NetworkOptions& options, const LoadedNetwork& loaded, std::ostream& out) {
  const Network& network = loaded.network();
  const auto row = [&](const char* name, const std::string& value) {
    out << pad_right(name, kNameWidth) << value << "\n";
  };
  row("file", options.file + ", " + std::to_string(loaded.file_bytes()) + " bytes, version " +
                  std::to_string(kNetworkFileVersion));
  row("weights", std::to_string(count_weights(network)));
  row("multiply-adds", fixed(1e-6 * static_cast<double>(network.multiply_adds()), 1) + " million");
  row("memory", mebibytes(required_bytes(network)) + " MiB");
  row("test vector", "computed as the file states");
  out << "\n";
  print_layers(network, out);
  out << "\nHow it was trained:\n";
  std::istringstream lines{std::string(network.provenance)};
  for (std::string line; std::getline(lines, line);) out << "  " << line << "\n";
}

void print_classes(const Network& network, const std::vector<std::size_t>& counts, std::ostream& out) {
  std::size_t all = 0;
  for (const std::size_t count : counts) all += count;
  out << "\n" << pad_right("class", kNameWidth) << pad_left("share", 8) << "  colour in the picture\n";
  for (std::size_t i = 0; i < network.class_count; ++i) {
    const cv::Vec3b colour = class_colour(i);
    std::array<char, 8> code{};
    std::snprintf(code.data(), code.size(), "#%02x%02x%02x", colour[2], colour[1], colour[0]);
    const double share = kPercent * static_cast<double>(counts[i]) / static_cast<double>(all);
    out << pad_right(std::string(network.classes[i]), kNameWidth) << pad_left(fixed(share, 1) + " %", 8)
        << "  " << code.data() << "\n";
  }
}

}  // namespace

void add_network_command(Program& program, NetworkOptions& options) {
  Command command =
      program.add_command("network", "Show what the file of a network holds, and what it makes of a picture");
  command.add_option("file", options.file, "File of a network (.tgn)").required();
  command.add_option("--picture", options.picture, "A JPEG or PNG to run it on");
  command.add_option("-o,--out", options.out,
                     "Write a PNG with the picture, its classes, borders and embedding");
}

int run_network(const NetworkOptions& options, std::ostream& out) {
  if (!options.out.empty() && options.picture.empty())
    throw UsageError("-o draws what the network makes of a picture: name one with --picture");
  const LoadedNetwork loaded(options.file);
  const AlignedBlock block(required_bytes(loaded.network()));
  NetworkRunner runner(loaded.network(), block.bytes());
  std::vector<std::size_t> counts;
  if (!options.picture.empty()) {
    const Picture picture = read_picture({options.picture, ""});
    const InputPlacement place = fill_input(picture.frame(), runner.input());
    const ImageView<std::uint8_t> input = runner.input();
    cv::Mat3b drawn;
    cv::cvtColor(cv::Mat(input.height, input.width / kPictureChannels, CV_8UC3, input.data), drawn,
                 cv::COLOR_RGB2BGR);
    runner.run();
    counts = count_classes(classes_of(runner.output(NetworkRole::classes)), loaded.network().class_count,
                           place, drawn.cols);
    if (!options.out.empty()) {
      const cv::Mat3b sheet = draw_network_sheet(drawn, runner);
      write_png(options.out, {sheet.data, sheet.cols, sheet.rows, static_cast<std::ptrdiff_t>(sheet.step),
                              PixelFormat::bgr8});
    }
  }
  print_file(options, loaded, out);
  if (!counts.empty()) print_classes(loaded.network(), counts, out);
  return kExitMeasured;
}

}  // namespace traygauge
