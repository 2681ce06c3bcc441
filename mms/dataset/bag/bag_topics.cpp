#include "mms/dataset/bag/bag_topics.hpp"

#include <algorithm>
#include <initializer_list>

#include "mms/core/error.hpp"
#include "mms/io/text/lower_case.hpp"
#include "mms/ros/cloud_messages.hpp"
#include "mms/ros/image_messages.hpp"
#include "mms/ros/raw_colors.hpp"

namespace mms {
namespace {

using Words = std::initializer_list<const char*>;

constexpr const char* kImage = "sensor_msgs/Image";
constexpr const char* kCompressed = "sensor_msgs/CompressedImage";
constexpr const char* kCloud = "sensor_msgs/PointCloud2";

bool has_word(const std::string& name, Words words) {
  const std::string lower = lower_case(name);
  return std::any_of(words.begin(), words.end(),
                     [&](const char* word) { return lower.find(word) != std::string::npos; });
}

bool is_type(const BagTopic& topic, Words types) {
  return std::any_of(types.begin(), types.end(),
                     [&](const char* type) { return topic.type == type; });
}

/// Length of the common prefix.
int common(const std::string& a, const std::string& b) {
  const auto ends = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  return static_cast<int>(ends.first - a.begin());
}

/// The name without the part that transports of compressed images add.
std::string without_transport(std::string topic) {
  for (const char* part : {"/compressedDepth", "/compressed"}) {
    if (topic.ends_with(part)) topic.resize(topic.rfind('/'));
  }
  return topic;
}

/// The name without its last part and the parts of compressed images.
std::string camera_of(const std::string& topic) {
  const std::string image = without_transport(topic);
  return image.substr(0, image.rfind('/') + 1);
}

/// Selection of one topic: the given one, or the best match.
class Choice {
 public:
  Choice(const std::vector<BagTopic>& topics, const std::string& where)
      : topics_(topics), where_(where) {}

  /// @param rank  positive for a matching topic, else 0. Of equal ranks the first topic wins.
  template <class Rank>
  std::string best(const Rank& rank) const {
    const BagTopic* chosen = nullptr;
    int highest = 0;
    for (const BagTopic& topic : topics_) {
      const int value = topic.count == 0 ? 0 : rank(topic);
      if (value <= highest) continue;
      highest = value;
      chosen = &topic;
    }
    return chosen == nullptr ? "" : chosen->name;
  }

  /// 0 for a missing topic.
  template <class Rank>
  int rank_of(const std::string& name, const Rank& rank) const {
    for (const BagTopic& topic : topics_) {
      if (topic.name == name) return rank(topic);
    }
    return 0;
  }

  /// A topic of the rank of `chosen` that belongs to another camera; empty for none.
  template <class Rank>
  std::string rival(const std::string& chosen, const Rank& rank) const {
    const int highest = rank_of(chosen, rank);
    for (const BagTopic& topic : topics_) {
      const bool other = camera_of(topic.name) != camera_of(chosen);
      if (other && topic.count > 0 && rank(topic) == highest) return topic.name;
    }
    return "";
  }

  /// The topic of a name that is given by an option, else the one that `find()` returns.
  /// @throws DataError if the given topic is missing or has none of the types.
  template <class Find>
  std::string pick(const std::string& name, const char* option, Words types,
                   const Find& find) const {
    return name.empty() ? find() : given(name, option, types);
  }

  [[noreturn]] void fail(const std::string& what, const std::string& hint = "") const {
    throw DataError(where_, what + "; it has " + listed(topics_), hint);
  }

 private:
  std::string given(const std::string& name, const char* option, Words types) const {
    const auto found = std::find_if(topics_.begin(), topics_.end(),
                                    [&](const BagTopic& topic) { return topic.name == name; });
    if (found == topics_.end()) fail(std::string(option) + " is " + name + ", which is missing");
    if (!is_type(*found, types)) {
      fail(std::string(option) + " is " + name + ", which has type " + found->type + ", expected " +
           listed_types(types));
    }
    if (found->count == 0) fail(std::string(option) + " is " + name + ", which has no messages");
    return name;
  }

  static std::string listed_types(Words types) {
    std::string text;
    for (const char* type : types) text += (text.empty() ? "" : " or ") + std::string(type);
    return text;
  }

  const std::vector<BagTopic>& topics_;
  const std::string& where_;
};

bool is_mask_name(const std::string& name) {
  return has_word(name, {"mask", "label", "segmentation"});
}

/// "16UC1" is always depth, "mono16" may also be an infrared image.
bool is_depth(const BagTopic& topic, const EncodingOf& encoding_of) {
  if (topic.type == kCompressed) return has_word(topic.name, {"depth"});
  if (topic.type != kImage || has_word(topic.name, {"infra", "confidence"})) return false;
  const std::string encoding = encoding_of(topic);
  return is_depth_encoding(encoding) && (encoding != "mono16" || has_word(topic.name, {"depth"}));
}

int depth_rank(const BagTopic& topic, const EncodingOf& encoding_of) {
  if (!is_depth(topic, encoding_of)) return 0;
  const bool compressed = topic.type == kCompressed;
  // JPEG has 8 bits, which are no depth: all else is better.
  if (compressed && has_word(encoding_of(topic), {"jpeg", "jpg"})) return 1;
  int rank = !compressed ? 4 : topic.name.ends_with("/compressedDepth") ? 3 : 2;
  if (has_word(topic.name, {"aligned", "registered", "to_color", "to_rgb"})) rank += 8;
  if (has_word(topic.name, {"depth"})) rank += 4;
  return rank;
}

/// Of color as the sensor sends it: all else was decoded by the camera's own driver.
constexpr int kRawRank = 1;

int color_rank(const BagTopic& topic, const EncodingOf& encoding_of) {
  const bool compressed = topic.type == kCompressed;
  if (!compressed && topic.type != kImage) return 0;
  if (is_mask_name(topic.name) || has_word(topic.name, {"depth", "infra", "confidence"})) {
    const bool beside_depth = has_word(topic.name, {"color", "rgb"}) && !is_mask_name(topic.name) &&
                              !is_depth(topic, encoding_of);
    if (!beside_depth) return 0;
  }
  const std::string encoding = compressed ? "" : encoding_of(topic);
  if (!compressed && !is_color_encoding(encoding)) return 0;
  if (raw_color_size(encoding) > 0) return kRawRank;
  int rank = compressed ? 1 : 2;
  if (encoding != "mono8" && encoding != "8UC1") rank += 4;
  if (has_word(topic.name, {"color", "rgb"})) rank += 8;
  return rank;
}

bool is_color_like(const std::string& encoding) {
  constexpr const char* kStarts[] = {"bayer_", "yuv", "uyvy",  "yuyv", "nv",
                                     "rgb",    "bgr", "16UC3", "16UC4"};
  return std::any_of(std::begin(kStarts), std::end(kStarts),
                     [&](const char* start) { return encoding.starts_with(start); });
}

/// Images that seem to be of color, in encodings that are not read: "/a is 'nv12', /b ...".
std::string unread_colors(const std::vector<BagTopic>& topics, const EncodingOf& encoding_of) {
  std::string text;
  for (const BagTopic& topic : topics) {
    if (topic.type != kImage || topic.count == 0 || is_mask_name(topic.name)) continue;
    if (has_word(topic.name, {"depth", "infra", "confidence"})) continue;
    const std::string encoding = encoding_of(topic);
    if (is_color_encoding(encoding) || !is_color_like(encoding)) continue;
    text += (text.empty() ? "" : ", ") + topic.name + " is '" + encoding + "'";
  }
  return text;
}

/// Of topics with equal rank, the one whose name begins most like `other` counts more.
int beside(int rank, const std::string& name, const std::string& other) {
  constexpr int kLongest = 1000;  // [characters] that count
  return rank == 0 ? 0 : rank * kLongest + std::min(common(name, other), kLongest - 1);
}

/// Clouds that programs made of scans, often in the world frame, and those of depth cameras count
/// less than all others, and a Livox less than another LiDAR. The number of messages decides among
/// the rest.
int cloud_rank(const BagTopic& topic) {
  constexpr std::size_t kLargestCount = 500'000'000;  // that count
  const bool livox = is_livox_type(topic.type);
  if (!livox && topic.type != kCloud) return 0;
  const bool made =
      has_word(topic.name, {"registered", "map", "global", "world", "filtered", "effected",
                            "corner", "surf", "feature", "segment", "cluster", "obstacle", "ground",
                            "static_cloud", "dynamic_cloud", "depth", "stereo", "disparity"});
  const auto count = static_cast<int>(std::min(topic.count, kLargestCount));
  const int tier = made ? 0 : livox ? 1 : 2;
  return tier * static_cast<int>(kLargestCount) + count;
}

/// @param depth   of the bag, which goes without color here; empty for none
/// @param unread  as of `unread_colors`
std::string find_cloud(const Choice& choice, const std::string& depth, const std::string& unread) {
  const std::string best = choice.best(cloud_rank);
  // The clouds of a depth camera are no scans of a LiDAR.
  if (!best.empty() && !unread.empty() && !depth.empty()) {
    choice.fail("has depth in " + depth + ", but color in an encoding that is not read: " + unread,
                "convert the images to rgb8, or choose the clouds with --topic-cloud " + best);
  }
  return best;
}

std::string find_camera_info(const Choice& choice, const std::string& color) {
  return choice.best([&](const BagTopic& topic) {
    if (topic.type != "sensor_msgs/CameraInfo") return 0;
    const bool own = topic.name == camera_info_beside(color);
    return own ? 100'000 : 1 + common(topic.name, color);
  });
}

/// Odometry by other sensors than wheels is no measurement of its own; poses called the truth are
/// no measurement at all.
std::string find_wheels(const Choice& choice, const std::string& truth) {
  return choice.best([&](const BagTopic& topic) {
    const bool other = has_word(
        topic.name,
        {"visual", "vio",      "vins",  "rgbd",  "camera",  "zed",       "t265",    "lidar",
         "laser",  "icp",      "loam",  "lio",   "slam",    "gps",       "gnss",    "ekf",
         "fus",    "filtered", "truth", "mocap", "vicon",   "optitrack", "/gt",     "mavros",
         "msckf",  "rovio",    "okvis", "kiss",  "rtabmap", "mapping",   "estimat", "global"});
    if (topic.type != "nav_msgs/Odometry" || topic.name == truth || other) return 0;
    if (topic.name == "/Odometry") return 0;  // as FAST-LIO calls its poses
    return has_word(topic.name, {"wheel"}) ? 2 : has_word(topic.name, {"odom"}) ? 1 : 0;
  });
}

/// Sensors of depth cameras have topics of their own for the two kinds of measurements. Of several
/// gyroscopes, that of the device counts whose name begins most like `frames`.
/// @param frames  topic of the clouds, or else of the color images
std::string find_imu(const Choice& choice, const std::string& frames) {
  return choice.best([&](const BagTopic& topic) {
    if (topic.type != "sensor_msgs/Imu") return 0;
    if (has_word(topic.name, {"accel"}) && !has_word(topic.name, {"gyro"})) return 0;
    return 1 + common(topic.name, frames);
  });
}

std::string find_truth(const Choice& choice) {
  return choice.best([](const BagTopic& topic) {
    const bool poses = is_type(topic, {"geometry_msgs/PoseStamped", "nav_msgs/Odometry",
                                       "geometry_msgs/TransformStamped"});
    const bool called = has_word(
        topic.name, {"ground_truth", "groundtruth", "truth", "mocap", "vicon", "optitrack", "/gt"});
    return poses && called ? 1 : 0;
  });
}

/// Topics of color, depth and clouds, see `choose_topics`.
BagTopicNames choose_frames(const Choice& choice, const std::vector<BagTopic>& topics,
                            const BagTopicNames& given, const EncodingOf& encoding_of) {
  const auto rank_color = [&](const BagTopic& topic) { return color_rank(topic, encoding_of); };
  const auto rank_depth = [&](const BagTopic& topic) { return depth_rank(topic, encoding_of); };
  BagTopicNames chosen;
  chosen.color = choice.pick(given.color, "--topic-color", {kImage, kCompressed}, [&] {
    return choice.best(
        [&](const BagTopic& topic) { return beside(rank_color(topic), topic.name, given.depth); });
  });
  const bool wants_cloud = !given.cloud.empty();
  chosen.depth = choice.pick(given.depth, "--topic-depth", {kImage, kCompressed}, [&] {
    if (wants_cloud || chosen.color.empty()) return std::string();
    return choice.best(
        [&](const BagTopic& topic) { return beside(rank_depth(topic), topic.name, chosen.color); });
  });
  if (given.color.empty() && given.depth.empty() && !chosen.depth.empty()) {
    const std::string second = choice.rival(chosen.color, rank_color);
    if (!second.empty() && !choice.rival(chosen.depth, rank_depth).empty()) {
      choice.fail("has several depth cameras, of " + chosen.color + " and " + second,
                  "choose one with --topic-color " + chosen.color);
    }
  }
  const std::string unread = chosen.color.empty() ? unread_colors(topics, encoding_of) : "";
  chosen.cloud = choice.pick(given.cloud, "--topic-cloud",
                             {kCloud, "livox_ros_driver/CustomMsg", "livox_ros_driver2/CustomMsg",
                              "livox_interfaces/CustomMsg"},
                             [&] {
                               if (!chosen.depth.empty()) return std::string();
                               return find_cloud(choice, choice.best(rank_depth), unread);
                             });
  // Beside a LiDAR, images as the sensor sends them count if they are named only.
  const bool raw = choice.rank_of(chosen.color, rank_color) == kRawRank;
  if (given.color.empty() && chosen.depth.empty() && raw) chosen.color.clear();
  if (chosen.cloud.empty() && (chosen.depth.empty() || chosen.color.empty())) {
    choice.fail(
        "has neither color images with depth nor point clouds" +
            (unread.empty() ? "" : "; encodings that are not read: " + unread),
        "expected sensor_msgs/Image or CompressedImage of color and of depth, or "
        "sensor_msgs/PointCloud2; select them with --topic-color, --topic-depth and --topic-cloud");
  }
  return chosen;
}

}  // namespace

std::string camera_info_beside(const std::string& topic) {
  return camera_of(topic) + "camera_info";
}

bool is_named_registered(const std::string& depth_topic) {
  const auto has = [&](const char* word) { return depth_topic.find(word) != std::string::npos; };
  return has("aligned") || has("registered") || has("to_color") || has("to_rgb");
}

BagTopicNames choose_topics(const std::vector<BagTopic>& topics, const BagTopicNames& given,
                            const EncodingOf& encoding_of, const std::string& where) {
  const Choice choice(topics, where);
  BagTopicNames chosen = choose_frames(choice, topics, given, encoding_of);
  if (!chosen.color.empty()) {
    chosen.camera_info =
        choice.pick(given.camera_info, "--topic-camera-info", {"sensor_msgs/CameraInfo"},
                    [&] { return find_camera_info(choice, chosen.color); });
    chosen.mask = choice.pick(given.mask, "--topic-mask", {kImage}, [&] {
      return choice.best([&](const BagTopic& topic) {
        if (topic.type != kImage || !is_mask_name(topic.name)) return 0;
        // Others are pictures of masks, or numbers of objects.
        return is_mask_encoding(encoding_of(topic)) ? 1 : 0;
      });
    });
  }
  chosen.truth = choice.pick(given.truth, "--topic-truth",
                             {"geometry_msgs/PoseStamped", "geometry_msgs/TransformStamped",
                              "nav_msgs/Odometry", "tf2_msgs/TFMessage", "tf/tfMessage"},
                             [&] { return find_truth(choice); });
  chosen.wheels = choice.pick(given.wheels, "--topic-wheels", {"nav_msgs/Odometry"},
                              [&] { return find_wheels(choice, chosen.truth); });
  chosen.imu = choice.pick(given.imu, "--topic-imu", {"sensor_msgs/Imu"}, [&] {
    return find_imu(choice, chosen.cloud.empty() ? chosen.color : chosen.cloud);
  });
  return chosen;
}

}  // namespace mms
