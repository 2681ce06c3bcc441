#include "mms/localization/registration/registration.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "mms/geometry/se3.hpp"
#include "mms/localization/registration/residuals.hpp"

namespace mms {
namespace {

/// [voxels]: motion of the pose after which features are associated again.
/// Source: initial choice; saves computing time, since few features change their counterpart.
constexpr double kReassociationShift = 0.1;

/// [-]: correlated residuals of an image that count as one measurement beside the prediction.
/// Source: six crowds (scene `crowd`) with late masks: with 1, the ATE of three of them was 4.9 to
/// 12.7 cm, with 10 it is 0.8 cm at most.
constexpr double kResidualsPerMeasurement = 10.0;

/// [-]: factor of the annealed scale from one round to the next.
/// Source: initial choice; from half a voxel of 8 cm four rounds reach the map's 4 mm.
constexpr double kScaleDecay = 0.5;

/// [-]: step over the annealed scale below which the scale decays.
/// Source: initial choice; a step that small changes the robust weights by a few percent.
constexpr double kConvergedStep = 0.1;

/// [px]: motion of the image at a level of the pyramid below which a step has no effect.
/// Source: a tenth of what the interpolation resolves. With the bound by the annealed scale alone,
/// the coarsest level ended after one step where the sensor began to turn: off by 25 cm in front of
/// a wall (`long_aisles`, seed 4).
constexpr double kConvergedPixels = 0.05;

/// Residuals of a photometric term within kInlierSigmas; t-weights are never zero.
int count_inliers(const PhotometricEquations& equations, double sigma) {
  const auto limit =
      std::min(equations.histogram.size(), static_cast<std::size_t>(kInlierSigmas * sigma) + 1);
  std::uint32_t inliers = 0;
  for (std::size_t bin = 0; bin < limit; ++bin) inliers += equations.histogram[bin];
  return static_cast<int>(inliers);
}

struct Step {
  Vector6d tangent = Vector6d::Zero();
  int degenerate_directions = 0;
};

/// Gauss-Newton step in the eigenvectors of the information matrix; those along which the pose's
/// standard deviation would exceed `max_sigma` [m, rad] have no step.
Step solve(const NormalEquations& equations, double max_sigma) {
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(equations.information);
  const double least = 1.0 / (max_sigma * max_sigma);
  const Vector6d along = eigen.eigenvectors().transpose() * equations.gradient;
  Step step;
  for (int i = 0; i < 6; ++i) {
    if (eigen.eigenvalues()(i) < least) {
      ++step.degenerate_directions;
    } else {
      step.tangent -= eigen.eigenvectors().col(i) * (along(i) / eigen.eigenvalues()(i));
    }
  }
  return step;
}

/// With a prediction, which counts like `weight` residuals.
/// @param is_complete  whether its standard deviation is known in all directions
Step solve(const NormalEquations& equations, const NormalEquations& prior, bool is_complete,
           double weight, double max_sigma) {
  Step step = solve(equations, max_sigma);
  NormalEquations sum;
  sum.information = equations.information + weight * prior.information;
  sum.gradient = equations.gradient + weight * prior.gradient;
  step.tangent = is_complete ? Vector6d(-sum.information.ldlt().solve(sum.gradient))
                             : solve(sum, max_sigma).tangent;
  return step;
}

/// The iterations of one frame.
class GaussNewton {
 public:
  GaussNewton(const FeatureCloud& features, const RegistrationTarget& target,
              const PosePrediction& prediction, const RegistrationConfig& config,
              const DepthNoise& noise)
      : features_(features),
        target_(target),
        prediction_(prediction),
        config_(config),
        noise_(noise),
        states_(target.keyframes.size()),
        scale_(median_range(features)) {
    result_.T_world_sensor = prediction.T_world_sensor;
  }

  RegistrationResult run() {
    const bool photometric =
        config_.photometric.enabled && !features_.intensity.empty() && !target_.keyframes.empty();
    annealed_scale_ = config_.geometric.initial_scale * target_.maps.voxel_size();
    if (photometric) {
      run_pyramid();
    } else {
      run_geometry();
    }
    return result_;
  }

 private:
  /// From the coarsest level of the intensity pyramid to the finest.
  void run_pyramid() {
    for (int level = static_cast<int>(features_.intensity.size()) - 1; level >= 0; --level) {
      for (PhotometricState& state : states_) state.sigma = PhotometricState{}.sigma;
      if (level == 0) annealed_scale_ = 0.0;
      iterate(level, config_.iterations_per_level);
      tighten();
    }
  }

  /// With residuals first weighted by the error of the first guess, at last by the noise.
  void run_geometry() {
    while (annealed_scale_ > 0.0 && result_.iterations < config_.max_iterations) {
      iterate(-1, config_.max_iterations - result_.iterations);
      tighten();
    }
    annealed_scale_ = 0.0;
    iterate(-1, std::max(1, config_.max_iterations - result_.iterations));
  }

  void tighten() {
    annealed_scale_ *= kScaleDecay;
    if (annealed_scale_ < config_.geometric.map_sigma) annealed_scale_ = 0.0;
  }

  /// @param level  of the intensity pyramid, -1 for none
  void iterate(int level, int max_iterations) {
    result_.converged = false;
    // While the annealed scale is larger than the noise, a step far below it has no effect.
    double small_step = kConvergedStep * annealed_scale_;  // of points [m]
    if (level >= 0) {
      const double focal = features_.intensity[static_cast<std::size_t>(level)].camera.fx;
      small_step = std::min(small_step, kConvergedPixels * scale_ / focal);
    }
    const double converged_translation = std::max(config_.converged_translation, small_step);
    const double converged_rotation =
        std::max(config_.converged_rotation, small_step / std::max(scale_, 1.0));
    for (int i = 0; i < max_iterations && !result_.converged; ++i) {
      const NormalEquations equations = linearize(level);
      const Step step = next_step(equations);
      result_.information = equations.information;
      result_.degenerate_directions = step.degenerate_directions;
      result_.T_world_sensor = result_.T_world_sensor * se3::exp(step.tangent);
      ++result_.iterations;
      result_.converged = step.tangent.head<3>().norm() < converged_translation &&
                          step.tangent.tail<3>().norm() < converged_rotation;
    }
    result_.T_world_sensor = se3::normalized(result_.T_world_sensor);
  }

  Step next_step(const NormalEquations& equations) const {
    const double max_sigma = std::hypot(config_.degenerate_sigma, annealed_scale_);
    if (!prediction_.is_informative()) return solve(equations, max_sigma);
    const double weight = features_.intensity.empty() ? 1.0 : kResidualsPerMeasurement;
    return solve(equations, prediction_.equations(result_.T_world_sensor),
                 prediction_.is_complete(), weight, max_sigma);
  }

  NormalEquations linearize(int level) {
    refresh_matches();
    result_.geometric =
        geometric_equations(matches_, result_.T_world_sensor, config_.geometric, annealed_scale_);
    NormalEquations sum = result_.geometric.edges;
    sum += result_.geometric.planes;
    if (level >= 0) add_photometric(static_cast<std::size_t>(level), sum);
    return sum;
  }

  /// Associates again once the pose has moved enough for another counterpart to be nearer.
  void refresh_matches() {
    const Eigen::Isometry3d moved = matched_at_.inverse() * result_.T_world_sensor;
    const double voxel = target_.maps.voxel_size();
    const double shift = moved.translation().norm() + scale_ * se3::angle(moved);
    if (associated_ && shift < kReassociationShift * voxel) return;
    matches_ = associate(features_, target_.maps, result_.T_world_sensor,
                         config_.geometric.association, config_.geometric.gate * voxel);
    matched_at_ = result_.T_world_sensor;
    associated_ = true;
  }

  void add_photometric(std::size_t level, NormalEquations& sum) {
    result_.intensity_inliers = 0;
    double sigmas = 0.0;
    int visible = 0;  // keyframes
    for (std::size_t k = 0; k < target_.keyframes.size(); ++k) {
      const IntensityKeyframe& keyframe = *target_.keyframes[k];
      if (level >= keyframe.levels.size()) continue;
      const PhotometricEquations photometric =
          photometric_equations(keyframe, level, features_.intensity[level], result_.T_world_sensor,
                                states_[k], config_.photometric, noise_);
      sum += photometric.equations;
      result_.intensity_inliers += count_inliers(photometric, states_[k].sigma);
      states_[k] = photometric.next(states_[k], config_.photometric.min_sigma);
      if (photometric.visible == 0) continue;
      sigmas += states_[k].sigma;
      ++visible;
    }
    result_.intensity_sigma = visible > 0 ? sigmas / visible : 0.0;
  }

  const FeatureCloud& features_;
  const RegistrationTarget& target_;
  const PosePrediction& prediction_;
  const RegistrationConfig& config_;
  DepthNoise noise_;
  std::vector<PhotometricState> states_;
  RegistrationResult result_;
  Matches matches_;
  Eigen::Isometry3d matched_at_ = Eigen::Isometry3d::Identity();
  bool associated_ = false;
  double annealed_scale_ = 0.0;  ///< standard deviation the pose's error adds to residuals [m]
  double scale_;                 ///< lever arm of a rotation: the median range [m]
};

}  // namespace

void RegistrationConfig::visit(ConfigVisitor& v) {
  v.integer({"max_iterations", "", "Gauss-Newton iterations of a frame without a photometric term"},
            max_iterations, {1, 200});
  v.integer({"iterations_per_level", "", "Gauss-Newton iterations per level of the pyramid"},
            iterations_per_level, {1, 100});
  v.number({"converged_translation", "m", "step below which the iteration ends"},
           converged_translation, {1e-9, 0.1});
  v.number({"converged_rotation", "rad", "step below which the iteration ends"}, converged_rotation,
           {1e-9, 0.1});
  v.number({"degenerate_sigma", "m, rad",
            "standard deviation of the pose along a direction above which it keeps its prediction"},
           degenerate_sigma, {1e-5, 10.0});
  v.group({"geometric", "", "edge and plane residuals"}, geometric);
  v.group({"photometric", "", "intensity residuals against keyframes (beyond the paper)"},
          photometric);
}

RegistrationResult register_frame(const FeatureCloud& features, const RegistrationTarget& target,
                                  const PosePrediction& prediction,
                                  const RegistrationConfig& config, const DepthNoise& noise) {
  return GaussNewton(features, target, prediction, config, noise).run();
}

}  // namespace mms
