#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mms/simulation/models/articulated_model.hpp"

namespace mms {

/// A vehicle assembled from moving parts.
class AgvAssembly {
 public:
  static constexpr std::size_t kBody = static_cast<std::size_t>(-1);

  /// T_parent_part of a moving part.
  using Joint = std::function<Eigen::Isometry3f(const Activity&)>;

  /// Adds a part attached to `parent`, or to the object frame for kBody; returns its index.
  std::size_t add(Mesh mesh, std::size_t parent, Joint joint);

  /// Adds a fixed part.
  std::size_t add(Mesh mesh, std::size_t parent, const Eigen::Isometry3f& T_parent_part);

  /// Returns the vehicle.
  std::unique_ptr<ArticulatedModel> finish(const std::string& kind);

 private:
  std::vector<Mesh> meshes_;
  std::vector<std::size_t> parents_;
  std::vector<Joint> joints_;
};

}  // namespace mms
