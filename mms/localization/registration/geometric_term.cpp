#include "mms/localization/registration/geometric_term.hpp"

#include <array>
#include <cmath>

#include "mms/geometry/parallel.hpp"
#include "mms/localization/registration/residuals.hpp"

namespace mms {
namespace {

/// [-]: matches of one parallel task; fixed, since it determines the order of the sums.
/// Source: tens of microseconds, long against the task's start.
constexpr std::size_t kChunk = 512;

/// Adds matches at one pose.
class Linearizer {
 public:
  Linearizer(const Eigen::Isometry3d& T, const GeometricConfig& config, double annealed_scale)
      : T_(T), config_(config), common_sigma_(std::hypot(config.map_sigma, annealed_scale)) {}

  void add(const EdgeMatch& match, GeometricEquations& sum) const {
    const VectorResidual r = point_to_line(T_, match.point, match.on_line, match.direction);
    const double sigma = std::hypot(match.sigma, common_sigma_);
    const double normalized = r.value.norm() / sigma;
    const double w = weight(normalized, sigma);
    sum.edges.information += w * r.jacobian.transpose() * r.jacobian;
    sum.edges.gradient += w * r.jacobian.transpose() * r.value;
    sum.edges.cost += w * r.value.squaredNorm();
    if (normalized < kInlierSigmas) ++sum.edges.inliers;
  }

  void add(const PlaneMatch& match, GeometricEquations& sum) const {
    const ScalarResidual r = point_to_plane(T_, match.point, match.on_plane, match.normal);
    const double sigma = std::hypot(match.sigma, common_sigma_);
    const double normalized = std::abs(r.value) / sigma;
    sum.planes.add(r.value, r.jacobian, weight(normalized, sigma));
    if (normalized < kInlierSigmas) ++sum.planes.inliers;
  }

 private:
  double weight(double normalized, double sigma) const {
    return config_.weight * cauchy_weight(normalized, config_.robust_scale) / (sigma * sigma);
  }

  Eigen::Isometry3d T_;
  const GeometricConfig& config_;
  double common_sigma_;  ///< part of the standard deviation all residuals share [m]
};

template <class Match>
GeometricEquations sum_over(const std::vector<Match>& matches, const Linearizer& linearizer) {
  return parallel_sum(matches.size(), kChunk, GeometricEquations{},
                      [&](std::size_t begin, std::size_t end) {
                        GeometricEquations part;
                        for (std::size_t i = begin; i < end; ++i) linearizer.add(matches[i], part);
                        return part;
                      });
}

}  // namespace

void GeometricConfig::visit(ConfigVisitor& v) {
  static constexpr std::array<std::string_view, 2> kAssociations = {"paper", "surface"};
  v.enumeration(
      {"association", "", "paper: 2 and 3 nearest points; surface: voxel means and normals"},
      association, kAssociations);
  v.boolean({"edges", "", "use edge features, eq. (3)"}, edges);
  v.boolean({"planes", "", "use planar features, eq. (4)"}, planes);
  v.number({"gate", "voxels", "largest distance of a feature to its counterpart"}, gate,
           {0.5, 20.0});
  v.number({"initial_scale", "voxels",
            "scale of the robust weights that a frame's registration starts with; it is annealed "
            "to the noise",
            "slack"},
           initial_scale, {0.0, 10.0});
  v.number({"map_sigma", "m", "error of the local maps, added to the measurement's"}, map_sigma,
           {1e-5, 1.0});
  v.number({"robust_scale", "", "standard deviations at which Cauchy's weight is one half"},
           robust_scale, {0.1, 100.0});
  v.number({"weight", "", "weight of the geometric residuals against the photometric"}, weight,
           {0.0, 1000.0});
}

GeometricEquations& GeometricEquations::operator+=(const GeometricEquations& other) {
  edges += other.edges;
  planes += other.planes;
  return *this;
}

double offered(const FeatureCloud& features, const GeometricConfig& config) {
  const std::size_t edges = config.edges ? features.edges.size() : 0;
  const std::size_t planes = config.planes ? features.planes.size() : 0;
  return static_cast<double>(edges + planes);
}

GeometricEquations geometric_equations(const Matches& matches,
                                       const Eigen::Isometry3d& T_world_sensor,
                                       const GeometricConfig& config, double annealed_scale) {
  const Linearizer linearizer(T_world_sensor, config, annealed_scale);
  GeometricEquations sum;
  if (config.planes) sum += sum_over(matches.planes, linearizer);
  if (config.edges) sum += sum_over(matches.edges, linearizer);
  return sum;
}

}  // namespace mms
