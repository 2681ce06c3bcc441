#include "mms/ros/message_types.hpp"

#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

namespace mms::msg {
namespace {

/// Fields of a type and the types that they use, in the order of ROS.
struct Entry {
  const char* md5;
  const char* fields;
  std::vector<std::string> parts;
};

using Entries = std::map<std::string, Entry, std::less<>>;

const Entries& entries() {
  static const std::vector<std::string> kPose = {"std_msgs/Header", "geometry_msgs/Pose",
                                                 "geometry_msgs/Point", "geometry_msgs/Quaternion"};
  static const std::vector<std::string> kTransform = {"std_msgs/Header", "geometry_msgs/Transform",
                                                      "geometry_msgs/Vector3",
                                                      "geometry_msgs/Quaternion"};
  static const Entries kEntries = {
      {"std_msgs/Header", {"", "uint32 seq\ntime stamp\nstring frame_id\n", {}}},
      {"std_msgs/Float32", {"73fcbf46b49191e672908e50842a83d4", "float32 data\n", {}}},
      {"geometry_msgs/Point", {"", "float64 x\nfloat64 y\nfloat64 z\n", {}}},
      {"geometry_msgs/Vector3", {"", "float64 x\nfloat64 y\nfloat64 z\n", {}}},
      {"geometry_msgs/Quaternion", {"", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n", {}}},
      {"geometry_msgs/Pose", {"", "Point position\nQuaternion orientation\n", {}}},
      {"geometry_msgs/Transform", {"", "Vector3 translation\nQuaternion rotation\n", {}}},
      {"geometry_msgs/Twist", {"", "Vector3 linear\nVector3 angular\n", {}}},
      {"geometry_msgs/PoseWithCovariance", {"", "Pose pose\nfloat64[36] covariance\n", {}}},
      {"geometry_msgs/TwistWithCovariance", {"", "Twist twist\nfloat64[36] covariance\n", {}}},
      {"sensor_msgs/RegionOfInterest",
       {"",
        "uint32 x_offset\nuint32 y_offset\nuint32 height\nuint32 width\nbool do_rectify\n",
        {}}},
      {"sensor_msgs/PointField",
       {"",
        "uint8 INT8=1\nuint8 UINT8=2\nuint8 INT16=3\nuint8 UINT16=4\nuint8 INT32=5\nuint8 "
        "UINT32=6\nuint8 FLOAT32=7\nuint8 FLOAT64=8\nstring name\nuint32 offset\nuint8 "
        "datatype\nuint32 count\n",
        {}}},
      {"sensor_msgs/Image",
       {"060021388200f6f0f447d0fcd9c64743",
        "Header header\nuint32 height\nuint32 width\nstring encoding\nuint8 is_bigendian\nuint32 "
        "step\nuint8[] data\n",
        {"std_msgs/Header"}}},
      {"sensor_msgs/CompressedImage",
       {"8f7a12909da2c9d3332d540a0977563f",
        "Header header\nstring format\nuint8[] data\n",
        {"std_msgs/Header"}}},
      {"sensor_msgs/CameraInfo",
       {"c9a58c1b0b154e0e6da7578cb991d214",
        "Header header\nuint32 height\nuint32 width\nstring distortion_model\nfloat64[] "
        "D\nfloat64[9] K\nfloat64[9] R\nfloat64[12] P\nuint32 binning_x\nuint32 "
        "binning_y\nRegionOfInterest roi\n",
        {"std_msgs/Header", "sensor_msgs/RegionOfInterest"}}},
      {"sensor_msgs/PointCloud2",
       {"1158d486dd51d683ce2f1be655c3c181",
        "Header header\nuint32 height\nuint32 width\nPointField[] fields\nbool "
        "is_bigendian\nuint32 point_step\nuint32 row_step\nuint8[] data\nbool is_dense\n",
        {"std_msgs/Header", "sensor_msgs/PointField"}}},
      {"livox_ros_driver2/CustomPoint",
       {"109a3cc548bb1f96626be89a5008bd6d",
        "uint32 offset_time\nfloat32 x\nfloat32 y\nfloat32 z\nuint8 reflectivity\nuint8 tag\nuint8 "
        "line\n",
        {}}},
      {"livox_ros_driver2/CustomMsg",
       {"e4d6829bdfe657cb6c21a746c86b21a6",
        "std_msgs/Header header\nuint64 timebase\nuint32 point_num\nuint8 lidar_id\nuint8[3] "
        "rsvd\nCustomPoint[] points\n",
        {"std_msgs/Header", "livox_ros_driver2/CustomPoint"}}},
      {"geometry_msgs/PoseStamped",
       {"d3812c3cbc69362b77dc0b19b345f8f5", "Header header\nPose pose\n", kPose}},
      {"geometry_msgs/PoseWithCovarianceStamped",
       {"953b798c0f514ff060a53a3498ce6246",
        "Header header\ngeometry_msgs/PoseWithCovariance pose\n",
        {"std_msgs/Header", "geometry_msgs/PoseWithCovariance", "geometry_msgs/Pose",
         "geometry_msgs/Point", "geometry_msgs/Quaternion"}}},
      {"geometry_msgs/TransformStamped",
       {"b5764a33bfeb3588febc2682852579b0",
        "Header header\nstring child_frame_id\nTransform transform\n", kTransform}},
      {"tf2_msgs/TFMessage",
       {"94810edda583a504dfda3829e70d7eec",
        "geometry_msgs/TransformStamped[] transforms\n",
        {"geometry_msgs/TransformStamped", "std_msgs/Header", "geometry_msgs/Transform",
         "geometry_msgs/Vector3", "geometry_msgs/Quaternion"}}},
      {"nav_msgs/Odometry",
       {"cd5e73d190d741a2f92e81eda573aca7",
        "Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance "
        "pose\ngeometry_msgs/TwistWithCovariance twist\n",
        {"std_msgs/Header", "geometry_msgs/PoseWithCovariance", "geometry_msgs/Pose",
         "geometry_msgs/Point", "geometry_msgs/Quaternion", "geometry_msgs/TwistWithCovariance",
         "geometry_msgs/Twist", "geometry_msgs/Vector3"}}},
      {"sensor_msgs/Imu",
       {"6a62c6daae103f4ff57a132d6f95cec2",
        "Header header\ngeometry_msgs/Quaternion orientation\nfloat64[9] "
        "orientation_covariance\ngeometry_msgs/Vector3 angular_velocity\nfloat64[9] "
        "angular_velocity_covariance\ngeometry_msgs/Vector3 linear_acceleration\nfloat64[9] "
        "linear_acceleration_covariance\n",
        {"std_msgs/Header", "geometry_msgs/Quaternion", "geometry_msgs/Vector3"}}},
      {"std_msgs/ColorRGBA", {"", "float32 r\nfloat32 g\nfloat32 b\nfloat32 a\n", {}}},
      {"diagnostic_msgs/KeyValue", {"", "string key\nstring value\n", {}}},
      {"diagnostic_msgs/DiagnosticStatus",
       {"",
        "byte OK=0\nbyte WARN=1\nbyte ERROR=2\nbyte STALE=3\nbyte level\nstring name\nstring "
        "message\nstring hardware_id\nKeyValue[] values\n",
        {}}},
      {"diagnostic_msgs/DiagnosticArray",
       {"60810da900de1dd6ddd437c3503511da",
        "Header header\nDiagnosticStatus[] status\n",
        {"std_msgs/Header", "diagnostic_msgs/DiagnosticStatus", "diagnostic_msgs/KeyValue"}}},
      {"nav_msgs/Path",
       {"6227e2b7e9cce15051f669a5e197bbf7",
        "Header header\ngeometry_msgs/PoseStamped[] poses\n",
        {"std_msgs/Header", "geometry_msgs/PoseStamped", "geometry_msgs/Pose",
         "geometry_msgs/Point", "geometry_msgs/Quaternion"}}},
      {"visualization_msgs/Marker",
       {"",
        "uint8 ARROW=0\nuint8 CUBE=1\nuint8 SPHERE=2\nuint8 CYLINDER=3\nuint8 LINE_STRIP=4\nuint8 "
        "LINE_LIST=5\nuint8 CUBE_LIST=6\nuint8 SPHERE_LIST=7\nuint8 POINTS=8\nuint8 "
        "TEXT_VIEW_FACING=9\nuint8 MESH_RESOURCE=10\nuint8 TRIANGLE_LIST=11\nuint8 ADD=0\nuint8 "
        "MODIFY=0\nuint8 DELETE=2\nuint8 DELETEALL=3\nHeader header\nstring ns\nint32 id\nint32 "
        "type\nint32 action\ngeometry_msgs/Pose pose\ngeometry_msgs/Vector3 "
        "scale\nstd_msgs/ColorRGBA color\nduration lifetime\nbool "
        "frame_locked\ngeometry_msgs/Point[] points\nstd_msgs/ColorRGBA[] colors\nstring "
        "text\nstring mesh_resource\nbool mesh_use_embedded_materials\n",
        {}}},
      {"visualization_msgs/MarkerArray",
       {"d155b9ce5188fbaf89745847fd5882d7",
        "Marker[] markers\n",
        {"visualization_msgs/Marker", "std_msgs/Header", "geometry_msgs/Pose",
         "geometry_msgs/Point", "geometry_msgs/Quaternion", "geometry_msgs/Vector3",
         "std_msgs/ColorRGBA"}}},
      {"mms_msgs/Instance",
       {"", "uint8 PERSON=0\nuint8 AGV=1\nuint8 object_class\nfloat32 score\nstring mask\n", {}}},
      {"mms_msgs/Masks",
       {"f6d92059c00e58b0a6bc11bf1f95f0d4",
        "Header header\nuint32 width\nuint32 height\nInstance[] instances\n",
        {"std_msgs/Header", "mms_msgs/Instance"}}},
      {"mms_msgs/Object",
       {"",
        "uint8 PERSON=0\nuint8 AGV=1\nuint8 UNKNOWN=2\nuint32 id\nuint8 object_class\nfloat32 "
        "score\nbool "
        "moving\ngeometry_msgs/Pose pose\ngeometry_msgs/Vector3 size\ngeometry_msgs/Vector3 "
        "velocity\n",
        {}}},
      {"mms_msgs/Objects",
       {"c4b1e6e18ca86e4ec5e372ed9196a91f",
        "Header header\nObject[] objects\n",
        {"std_msgs/Header", "mms_msgs/Object", "geometry_msgs/Pose", "geometry_msgs/Point",
         "geometry_msgs/Quaternion", "geometry_msgs/Vector3"}}},
  };
  return kEntries;
}

std::string part_of(const std::string& name, const std::string& fields) {
  return std::string(80, '=') + "\nMSG: " + name + "\n" + fields;
}

std::string definition_of(const Entry& entry) {
  std::string text = entry.fields;
  for (const std::string& part : entry.parts) {
    text += part_of(part, entries().find(part)->second.fields);
  }
  return text;
}

/// Types that are parts of markers in ROS 2 only.
constexpr std::pair<const char*, const char*> kMarkerParts[] = {
    {"builtin_interfaces/Duration", "int32 sec\nuint32 nanosec\n"},
    {"sensor_msgs/CompressedImage", "std_msgs/Header header\nstring format\nuint8[] data\n"},
    {"visualization_msgs/UVCoordinate", "float32 u\nfloat32 v\n"},
    {"visualization_msgs/MeshFile", "string filename\nuint8[] data\n"}};

/// Lines of ROS 1 and what they are in ROS 2.
constexpr std::pair<std::string_view, std::string_view> kRos2Lines[] = {
    {"uint32 seq\n", ""},
    {"time stamp\n", "builtin_interfaces/Time stamp\n"},
    {"Header header\n", "std_msgs/Header header\n"},
    {"float64[] D\nfloat64[9] K\nfloat64[9] R\nfloat64[12] P\n",
     "float64[] d\nfloat64[9] k\nfloat64[9] r\nfloat64[12] p\n"},
    {"duration lifetime\n", "builtin_interfaces/Duration lifetime\n"},
    {"std_msgs/ColorRGBA[] colors\n",
     "std_msgs/ColorRGBA[] colors\nstring texture_resource\nsensor_msgs/CompressedImage "
     "texture\nUVCoordinate[] uv_coordinates\n"},
    {"string mesh_resource\n", "string mesh_resource\nMeshFile mesh_file\n"}};

/// Replaces what lines begin with.
void replace_starts(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at)) {
    const bool starts_line = at == 0 || text[at - 1] == '\n';
    if (starts_line) text.replace(at, from.size(), to);
    at += starts_line ? to.size() : from.size();
  }
}

std::string ros2_definition_of(std::string_view name, std::string text) {
  if (name.starts_with("visualization_msgs/")) {
    replace_starts(text, "uint8 ", "int32 ");  // its constants
    for (const auto& [part, fields] : kMarkerParts) text += part_of(part, fields);
  }
  for (const auto& [ros1, ros2] : kRos2Lines) replace_starts(text, ros1, ros2);
  if (text.find("builtin_interfaces/Time") == std::string::npos) return text;
  return text + part_of("builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n");
}

std::map<std::string, MessageType, std::less<>> make_types() {
  std::map<std::string, MessageType, std::less<>> types;
  for (const auto& [name, entry] : entries()) {
    const std::string definition = definition_of(entry);
    types.emplace(name,
                  MessageType{name, entry.md5, definition, ros2_definition_of(name, definition)});
  }
  return types;
}

}  // namespace

const MessageType& message_type(std::string_view name) {
  static const auto kTypes = make_types();
  const auto found = kTypes.find(name);
  if (found == kTypes.end()) throw std::out_of_range("no such message: " + std::string(name));
  return found->second;
}

}  // namespace mms::msg
