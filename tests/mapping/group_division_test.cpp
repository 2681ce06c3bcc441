#include "mms/mapping/tracking/group_division.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <set>

namespace mms {
namespace {

const GroundFrame kGround(-Eigen::Vector3d::UnitY());

/// A cloud of clusters of points, unorganised as from any sensor.
class Scene {
 public:
  explicit Scene(const Eigen::Isometry3d& T_world_sensor = Eigen::Isometry3d::Identity())
      : T_world_sensor_(T_world_sensor) {}

  int add_cluster(ObjectClass object_class) {
    DynamicCluster cluster;
    cluster.object_class = object_class;
    cloud_.clusters.push_back(cluster);
    return static_cast<int>(cloud_.clusters.size()) - 1;
  }

  /// The visible half of an upright cylinder; its indices.
  std::set<std::size_t> add_body(int cluster, double x, double z, double radius = 0.25,
                                 int points = 600) {
    std::uniform_real_distribution<double> angle(std::numbers::pi, 2.0 * std::numbers::pi);
    std::uniform_real_distribution<double> height(-0.8, 0.9);
    std::set<std::size_t> indices;
    for (int i = 0; i < points; ++i) {
      const double a = angle(random_);
      const Eigen::Vector3d world(x + radius * std::cos(a), height(random_),
                                  z + radius * std::sin(a));
      indices.insert(add_point(cluster, world));
    }
    return indices;
  }

  std::size_t add_point(int cluster, const Eigen::Vector3d& world) {
    cloud_.points.push_back((T_world_sensor_.inverse() * world).cast<float>());
    cloud_.cluster.push_back(static_cast<std::int16_t>(cluster));
    return cloud_.points.size() - 1;
  }

  ClusterParts divide() const {
    return divide_groups(cloud_, Transform<World, Sensor>(T_world_sensor_), kGround, {});
  }

 private:
  Eigen::Isometry3d T_world_sensor_;
  LabeledCloud cloud_;
  std::mt19937 random_{7};
};

/// The parts that points belong to.
std::set<int> parts_of(const ClusterParts& parts, const std::set<std::size_t>& points) {
  std::set<int> found;
  for (const std::size_t i : points) found.insert(parts.part[i]);
  return found;
}

TEST(GroupDivision, KeepsSinglePersonWhole) {
  Scene scene;
  scene.add_body(scene.add_cluster(ObjectClass::kPerson), 0.5, 4.0, 0.4);
  EXPECT_EQ(scene.divide().cluster, std::vector<std::size_t>{0});
}

TEST(GroupDivision, SeparatesPeopleInOneCluster) {
  for (const double rotation : {0.0, 0.7, 2.5}) {
    Scene scene(Eigen::Translation3d(1.0, 0.2, -0.5) *
                Eigen::AngleAxisd(rotation, Eigen::Vector3d(0.2, 1.0, 0.1).normalized()));
    scene.add_body(scene.add_cluster(ObjectClass::kPerson), -2.0, 3.0);
    const int group = scene.add_cluster(ObjectClass::kPerson);
    const auto front = scene.add_body(group, 0.0, 4.0);
    const auto behind = scene.add_body(group, 0.3, 5.2, 0.25, 300);
    const auto beside = scene.add_body(group, 1.3, 4.6);
    const ClusterParts parts = scene.divide();
    EXPECT_EQ(parts.cluster, (std::vector<std::size_t>{0, 1, 1, 1}));
    std::set<int> all;
    for (const auto& body : {front, behind, beside}) {
      const std::set<int> of_body = parts_of(parts, body);
      ASSERT_EQ(of_body.size(), 1U) << "rotation " << rotation;
      all.insert(*of_body.begin());
    }
    EXPECT_EQ(all, (std::set<int>{1, 2, 3}));
  }
}

TEST(GroupDivision, OutliersFormNoPart) {
  Scene scene;
  const int cluster = scene.add_cluster(ObjectClass::kPerson);
  scene.add_body(cluster, 0.0, 4.0);
  for (int i = 0; i < 60; ++i) scene.add_point(cluster, {0.1, 0.0, 4.2 + 0.02 * i});
  EXPECT_EQ(scene.divide().cluster, std::vector<std::size_t>{0});
}

TEST(GroupDivision, DoesNotDivideVehicles) {
  Scene scene;
  const int cluster = scene.add_cluster(ObjectClass::kAgv);
  scene.add_body(cluster, 0.0, 4.0);
  scene.add_body(cluster, 2.4, 4.0);
  EXPECT_EQ(scene.divide().cluster, std::vector<std::size_t>{0});
}

TEST(GroupDivision, AssignsNoPartToInvalidOrUnclusteredPoints) {
  Scene scene;
  scene.add_cluster(ObjectClass::kPerson);
  const int cluster = scene.add_cluster(ObjectClass::kPerson);
  const std::size_t invalid = scene.add_point(cluster, Eigen::Vector3d::Constant(NAN));
  const std::size_t unclustered = scene.add_point(-1, {0.0, 0.0, 3.0});
  const auto body = scene.add_body(cluster, 0.0, 4.0);
  const ClusterParts parts = scene.divide();
  EXPECT_EQ(parts.cluster, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(parts.part[invalid], -1);
  EXPECT_EQ(parts.part[unclustered], -1);
  EXPECT_EQ(parts_of(parts, body), std::set<int>{1});
}

}  // namespace
}  // namespace mms
