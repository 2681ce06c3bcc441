#include "mms/run/segmenter/network_detector.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "mms/core/error.hpp"
#include "mms/io/weights/safetensors.hpp"
#include "mms/run/segmenter/torch_backend.hpp"
#include "mms/segmentation/engine/engine_detector.hpp"
#include "mms/segmentation/onnx/onnx_detector.hpp"
#include "mms/segmentation/weights/model.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDefaultNetwork = "everyday";

/// Folders of the program, and of the shared library that this is part of, as the Python module.
std::vector<fs::path> code_folders() {
  std::error_code fault;
  std::vector<fs::path> folders = {fs::read_symlink("/proc/self/exe", fault).parent_path()};
  Dl_info library;
  if (dladdr(reinterpret_cast<const void*>(&weights_path), &library) != 0) {
    folders.push_back(fs::path(library.dli_fname).parent_path());
  }
  return folders;
}

bool wants_torch(const SegmentationModel& model, const SegmentationConfig& config) {
  if (config.backend != NetworkBackend::kAuto) return config.backend == NetworkBackend::kLibtorch;
  const bool deformable = model.network.backbone.sac == SacMode::kDeformable;
  return deformable || torch_has_gpu();
}

engine::Quantization quantization_of(const SegmentationModel& model, const std::string& where,
                                     NetworkPrecision precision) {
  if (precision == NetworkPrecision::kFloat32) return {};
  engine::Quantization quantization = engine::unpack_quantization(model.weights, where);
  if (precision == NetworkPrecision::kAuto || !quantization.ranges.empty()) return quantization;
  throw DataError(where, "is not quantized, but segmentation.precision is int8",
                  "calibrate it with mms quantize");
}

std::unique_ptr<Detector> make_solo(const fs::path& path, const SegmentationConfig& config) {
  const std::string where = path.string();
  SegmentationModel model = unpack_model(read_safetensors(path), where);
  if (config.long_side > 0) resize_input(model.network, config.long_side);
  if (wants_torch(model, config)) return make_torch_detector(model, where, config);
  engine::Quantization quantization = quantization_of(model, where, config.precision);
  return std::make_unique<engine::EngineDetector>(std::move(model), where, std::move(quantization),
                                                  config.decoder, config.threads);
}

fs::path shipped_weights(const std::string& name) {
  const std::string file_name = "weights/" + name + ".safetensors";
  for (const fs::path& folder : code_folders()) {
    for (const char* base :
         {"../share/mms", "../..", "..", "../../../../share/mms", "../../../.."}) {
      const fs::path file = folder / base / file_name;
      if (fs::exists(file)) return fs::weakly_canonical(file);
    }
  }
  throw FileError(file_name, "is neither in share/mms/ of the installation nor in the source tree",
                  "give --weights FILE, or use --segmenter masks or none");
}

}  // namespace

fs::path weights_path(const std::string& weights) {
  if (weights.empty()) return shipped_weights(kDefaultNetwork);
  const bool is_name =
      weights.find_first_of("./") == std::string::npos && !fs::is_regular_file(weights);
  return is_name ? shipped_weights(weights) : fs::path(weights);
}

std::unique_ptr<Detector> make_detector(const SegmentationConfig& config) {
  const fs::path path = weights_path(config.weights);
  if (path.extension() == ".onnx") {
    return std::make_unique<OnnxDetector>(path, config.onnx, config.threads);
  }
  return make_solo(path, config);
}

void resize_input(NetworkConfig& network, int long_side) {
  const double scale = static_cast<double>(long_side) / network.long_side;
  network.short_side = static_cast<int>(std::lround(scale * network.short_side));
  network.long_side = long_side;
}

std::unique_ptr<Segmenter> make_network_segmenter(const SegmentationConfig& config) {
  SegmentationConfig adjusted = config;  // rejected masks need not be computed
  adjusted.decoder.score = std::max(adjusted.decoder.score, config.objects.score);
  return std::make_unique<NetworkSegmenter>(make_detector(adjusted), config.objects);
}

}  // namespace mms
