#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mms/ros/ros_messages.hpp"

namespace mms::msg {

// Messages that show and exchange results; as in messages.hpp.

/// nav_msgs/Path
struct Path {
  static constexpr std::string_view kTypeName = "nav_msgs/Path";
  Header header;
  std::vector<PoseStamped> poses;

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.header, self.poses);
  }
};

/// Fields of a marker that ROS 2 alone has, without use here: texture_resource, texture,
/// uv_coordinates.
struct MarkerTexture {
  std::string resource;
  CompressedImage image;
  std::vector<std::array<float, 2>> coordinates;

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.resource, self.image, self.coordinates);
  }
};

/// visualization_msgs/MeshFile, as `MarkerTexture`
struct MeshFile {
  std::string filename;
  std::vector<std::uint8_t> data;

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.filename, self.data);
  }
};

/// visualization_msgs/Marker
struct Marker {
  enum Type : std::int32_t { kCube = 1, kText = 9 };
  enum Action : std::int32_t { kAdd = 0, kDeleteAll = 3 };

  Header header;
  std::string ns;
  std::int32_t id = 0;
  std::int32_t type = kCube;
  std::int32_t action = kAdd;
  Pose pose;
  std::array<double, 3> scale{};
  std::array<float, 4> color{};  ///< r g b a in [0, 1]
  Duration lifetime{0};
  bool frame_locked = false;
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<float, 4>> colors;
  MarkerTexture texture;
  std::string text;
  std::string mesh_resource;
  MeshFile mesh_file;
  bool mesh_use_embedded_materials = false;

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.header, self.ns, self.id, self.type, self.action, self.pose, self.scale,
            self.color, self.lifetime, self.frame_locked, self.points, self.colors);
    if (!archive.is_ros1()) archive(self.texture);
    archive(self.text, self.mesh_resource);
    if (!archive.is_ros1()) archive(self.mesh_file);
    archive(self.mesh_use_embedded_materials);
  }
};

/// visualization_msgs/MarkerArray
struct MarkerArray {
  static constexpr std::string_view kTypeName = "visualization_msgs/MarkerArray";
  std::vector<Marker> markers;

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.markers);
  }
};

/// diagnostic_msgs/KeyValue
struct KeyValue {
  std::string key;
  std::string value;

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.key, self.value);
  }
};

/// diagnostic_msgs/DiagnosticStatus
struct DiagnosticStatus {
  enum Level : std::int8_t { kOk = 0, kWarn = 1, kError = 2 };

  std::int8_t level = kOk;
  std::string name;
  std::string message;
  std::string hardware_id;
  std::vector<KeyValue> values;

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.level, self.name, self.message, self.hardware_id, self.values);
  }
};

/// diagnostic_msgs/DiagnosticArray
struct DiagnosticArray {
  static constexpr std::string_view kTypeName = "diagnostic_msgs/DiagnosticArray";
  Header header;
  std::vector<DiagnosticStatus> status;

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.header, self.status);
  }
};

/// mms_msgs/Instance
struct Instance {
  std::uint8_t object_class = 0;
  float score = 1.0F;
  std::string mask;  ///< compressed form of io/rle.hpp

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.object_class, self.score, self.mask);
  }
};

/// mms_msgs/Masks
struct Masks {
  static constexpr std::string_view kTypeName = "mms_msgs/Masks";
  Header header;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<Instance> instances;

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.header, self.width, self.height, self.instances);
  }
};

/// mms_msgs/Object
struct Object {
  std::uint32_t id = 0;
  std::uint8_t object_class = 0;
  float score = 1.0F;
  bool moving = false;
  Pose pose;
  std::array<double, 3> size{};
  std::array<double, 3> velocity{};

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.id, self.object_class, self.score, self.moving, self.pose, self.size,
            self.velocity);
  }
};

/// mms_msgs/Objects
struct Objects {
  static constexpr std::string_view kTypeName = "mms_msgs/Objects";
  Header header;
  std::vector<Object> objects;

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.header, self.objects);
  }
};

}  // namespace mms::msg
