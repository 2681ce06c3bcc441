#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <functional>
#include <type_traits>

namespace mms {

/// Mean and covariance of weighted points in one pass. Add points relative to one of them: of
/// coordinates far larger than their spread, the difference of the sums keeps few digits.
template <class Scalar, int Dimension>
class PointSums {
 public:
  using Vector = Eigen::Matrix<Scalar, Dimension, 1>;
  using Matrix = Eigen::Matrix<Scalar, Dimension, Dimension>;

  void add(const Vector& point, Scalar weight = 1) {
    ++count_;
    weight_ += weight;
    sum_ += weight * point;
    squares_ += weight * point * point.transpose();
  }

  int count() const { return count_; }
  Scalar weight() const { return weight_; }
  Vector mean() const { return sum_ / weight_; }

  /// Of the points as they are, not of a population that they are drawn from.
  Matrix covariance() const {
    const Vector center = mean();
    return squares_ / weight_ - center * center.transpose();
  }

 private:
  int count_ = 0;
  Scalar weight_ = 0;
  Vector sum_ = Vector::Zero();
  Matrix squares_ = Matrix::Zero();
};

/// Mean of points, and the sum of (p - mean) (p - mean)^T.
template <class Scalar, int Dimension>
struct Scatter {
  Eigen::Matrix<Scalar, Dimension, 1> mean = Eigen::Matrix<Scalar, Dimension, 1>::Zero();
  Eigen::Matrix<Scalar, Dimension, Dimension> matrix =
      Eigen::Matrix<Scalar, Dimension, Dimension>::Zero();
};

/// In two passes, accurate whatever the coordinates are. NaN for no points.
/// @param position  of an element of `points`: a function or a pointer to a member
template <class Points, class Position = std::identity>
auto scatter_of(const Points& points, Position position = {}) {
  using Element = typename Points::value_type;
  using Vector = std::remove_cvref_t<std::invoke_result_t<Position, const Element&>>;
  using Scalar = typename Vector::Scalar;
  Scatter<Scalar, Vector::RowsAtCompileTime> scatter;
  for (const Element& element : points) scatter.mean += std::invoke(position, element);
  scatter.mean /= static_cast<Scalar>(points.size());
  for (const Element& element : points) {
    const Vector offset = std::invoke(position, element) - scatter.mean;
    scatter.matrix += offset * offset.transpose();
  }
  return scatter;
}

/// Principal components of a covariance or scatter matrix.
template <class Scalar, int Dimension>
struct PrincipalAxes {
  Eigen::Matrix<Scalar, Dimension, 1> variances;     ///< ascending; may be slightly negative for 0
  Eigen::Matrix<Scalar, Dimension, Dimension> axes;  ///< unit columns in the order of `variances`

  Eigen::Matrix<Scalar, Dimension, 1> smallest() const { return axes.col(0); }
  Eigen::Matrix<Scalar, Dimension, 1> largest() const { return axes.col(Dimension - 1); }
};

enum class EigenMethod {
  kIterative,   ///< QR iterations: accurate to rounding
  kClosedForm,  ///< roots of the characteristic polynomial: fast, accurate to its square root
};

template <class Scalar, int Dimension>
PrincipalAxes<Scalar, Dimension> principal_axes(
    const Eigen::Matrix<Scalar, Dimension, Dimension>& covariance,
    EigenMethod method = EigenMethod::kIterative) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix<Scalar, Dimension, Dimension>> solver;
  if (method == EigenMethod::kClosedForm) {
    solver.computeDirect(covariance);
  } else {
    solver.compute(covariance);
  }
  return {solver.eigenvalues(), solver.eigenvectors()};
}

/// `axis` or its opposite, so that it does not point against `direction`.
template <class Vector>
Vector oriented(const Vector& axis, const Vector& direction) {
  return axis.dot(direction) < 0 ? Vector(-axis) : axis;
}

}  // namespace mms
