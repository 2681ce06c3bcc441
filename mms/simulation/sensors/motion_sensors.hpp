#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <vector>

#include "mms/core/config_visitor.hpp"
#include "mms/core/motion_samples.hpp"

namespace mms {

/// Faults that both sensors of motion can have.
struct MotionFaults {
  double stuck_from = 0.0;      ///< the measurement does not change from then on [s]; 0: never
  double delay = 0.0;           ///< stamps are later than the measurement by this [s]
  double mounting_error = 0.0;  ///< of the calibration, about a fixed axis [degrees]

  void visit(ConfigVisitor& v);
};

/// Dead reckoning of a base that drives and turns on the floor. The signs of the errors follow from
/// the seed.
struct WheelConfig {
  bool enabled = false;
  double rate = 50.0;         ///< [Hz]
  double scale_error = 0.01;  ///< of all distances
  double turn_error = 0.02;   ///< of all turns
  double noise = 0.002;       ///< of the distance after one meter, growing with its square root [m]
  double turn_noise = 0.003;  ///< of the heading after one radian, likewise [rad]
  double slip = 0.0;          ///< share by which slipping wheels exceed the distance
  double slip_from = 5.0;     ///< [s]
  double slip_for = 2.0;      ///< [s]
  double jitter = 0.0;        ///< fault: independent error of every position [m]
  MotionFaults faults;

  void visit(ConfigVisitor& v);
};

/// A gyroscope with accelerometer fixed to the sensor, of a phone or a camera. Defaults: Bosch
/// BMI055 data sheet, 0.014 degrees/s per root Hz, 150 micro-g per root Hz; offset after
/// calibration at the factory 0.5 degrees/s.
struct ImuConfig {
  bool enabled = false;
  double rate = 200.0;                 ///< [Hz]
  double noise = 2.4e-4;               ///< of the rates [rad/s per root Hz]
  double bias = 0.01;                  ///< of the rates, in a direction of the seed [rad/s]
  double bias_walk = 1e-4;             ///< change of the bias after one second [rad/s]
  double scale_error = 0.005;          ///< of the rates
  double acceleration_noise = 1.5e-3;  ///< [m/s^2 per root Hz]
  double jitter = 0.0;                 ///< fault: more noise of every rate [rad/s]
  MotionFaults faults;

  void visit(ConfigVisitor& v);
};

/// A pose as a function of time [s].
using PoseAt = std::function<Eigen::Isometry3d(double)>;

/// @param T_building_base  of the base, on the floor
std::vector<WheelSample> measure_wheels(const PoseAt& T_building_base, double seconds,
                                        const WheelConfig& config, std::uint64_t seed);

/// @param T_building_imu  of the gyroscope, z of the building up
std::vector<ImuSample> measure_imu(const PoseAt& T_building_imu, double seconds,
                                   const ImuConfig& config, std::uint64_t seed);

}  // namespace mms
