#pragma once

#include <array>
#include <filesystem>
#include <optional>

namespace mms {

/// A calibration in place of the recording's own.
struct CameraOptions {
  std::filesystem::path file{};                       ///< as calibration.yaml; empty: none
  std::optional<std::array<double, 4>> intrinsics{};  ///< fx fy cx cy [px], without distortion
  std::optional<double> depth_scale{};                ///< depth image units per meter

  /// Whether nothing is given.
  bool empty() const { return *this == CameraOptions(); }
  bool operator==(const CameraOptions&) const = default;
};

}  // namespace mms
