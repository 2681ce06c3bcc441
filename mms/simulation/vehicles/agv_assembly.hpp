#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mms/simulation/models/articulated_model.hpp"

namespace mms {

/// A vehicle put together from parts that move against each other.
class AgvAssembly {
 public:
  static constexpr std::size_t kBody = static_cast<std::size_t>(-1);

  /// T_parent_part of a part that moves.
  using Joint = std::function<Eigen::Isometry3f(const Activity&)>;

  /// Adds a part that hangs on part `parent`, or stands in the object frame for kBody; returns its
  /// index.
  std::size_t add(Mesh mesh, std::size_t parent, Joint joint);

  /// ... that is fixed there.
  std::size_t add(Mesh mesh, std::size_t parent, const Eigen::Isometry3f& T_parent_part);

  /// The vehicle.
  std::unique_ptr<ArticulatedModel> finish(const std::string& kind);

 private:
  std::vector<Mesh> meshes_;
  std::vector<std::size_t> parents_;
  std::vector<Joint> joints_;
};

}  // namespace mms
