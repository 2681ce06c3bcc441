#include "mms/global_map/loops/loop.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace mms {

double Loop::sigma() const {
  const Eigen::Matrix3d translation = information.topLeftCorner<3, 3>();
  const double least = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(translation).eigenvalues()(0);
  return least > 0.0 ? 1.0 / std::sqrt(least) : 0.0;
}

}  // namespace mms
