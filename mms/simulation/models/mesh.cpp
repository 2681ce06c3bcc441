#include "mms/simulation/models/mesh.hpp"

#include <utility>

namespace mms {

void append(Mesh& mesh, const Mesh& part, const Eigen::Isometry3f& T) {
  const auto first_vertex = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto first_material = static_cast<std::uint32_t>(mesh.materials.size());
  mesh.materials.insert(mesh.materials.end(), part.materials.begin(), part.materials.end());
  for (const Vertex& vertex : part.vertices) {
    mesh.vertices.push_back({T * vertex.position, T.linear() * vertex.normal, vertex.uv});
  }
  for (Triangle triangle : part.triangles) {
    for (std::uint32_t& corner : triangle.corners) corner += first_vertex;
    triangle.material += first_material;
    mesh.triangles.push_back(triangle);
  }
}

void mirror(Mesh& mesh) {
  for (Vertex& vertex : mesh.vertices) {
    vertex.position.x() = -vertex.position.x();
    vertex.normal.x() = -vertex.normal.x();
  }
  for (Triangle& triangle : mesh.triangles) std::swap(triangle.corners[1], triangle.corners[2]);
}

Eigen::AlignedBox3f bounds(const Mesh& mesh, const Eigen::Isometry3f& T) {
  Eigen::AlignedBox3f box;
  for (const Vertex& vertex : mesh.vertices) box.extend(T * vertex.position);
  return box;
}

}  // namespace mms
