#include "mms/simulation/vehicles/agv_assembly.hpp"

#include <utility>

namespace mms {
namespace {

class Agv : public ArticulatedModel {
 public:
  Agv(std::string kind, std::vector<Mesh> meshes, std::vector<std::size_t> parents,
      std::vector<AgvAssembly::Joint> joints)
      : kind_(std::move(kind)),
        meshes_(std::move(meshes)),
        parents_(std::move(parents)),
        joints_(std::move(joints)) {}

  ObjectClass object_class() const override { return ObjectClass::kAgv; }
  std::string kind() const override { return kind_; }
  const std::vector<Mesh>& parts() const override { return meshes_; }

  std::vector<Eigen::Isometry3f> pose(const Activity& activity) const override {
    std::vector<Eigen::Isometry3f> poses;
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      const Eigen::Isometry3f T_parent_part = joints_[i](activity);
      const bool fixed = parents_[i] == AgvAssembly::kBody;
      poses.push_back(fixed ? T_parent_part : poses[parents_[i]] * T_parent_part);
    }
    return poses;
  }

 private:
  std::string kind_;
  std::vector<Mesh> meshes_;
  std::vector<std::size_t> parents_;  ///< always before their children
  std::vector<AgvAssembly::Joint> joints_;
};

}  // namespace

std::size_t AgvAssembly::add(Mesh mesh, std::size_t parent, Joint joint) {
  meshes_.push_back(std::move(mesh));
  parents_.push_back(parent);
  joints_.push_back(std::move(joint));
  return meshes_.size() - 1;
}

std::size_t AgvAssembly::add(Mesh mesh, std::size_t parent,
                             const Eigen::Isometry3f& T_parent_part) {
  return add(std::move(mesh), parent, [T_parent_part](const Activity&) { return T_parent_part; });
}

std::unique_ptr<ArticulatedModel> AgvAssembly::finish(const std::string& kind) {
  return std::make_unique<Agv>(kind, std::move(meshes_), std::move(parents_), std::move(joints_));
}

}  // namespace mms
