#include "mms/dataset/bag/bag_recording.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "mms/core/error.hpp"
#include "mms/core/upper_median.hpp"
#include "mms/dataset/bag/bag_calibration.hpp"
#include "mms/dataset/bag/bag_motion.hpp"
#include "mms/dataset/bag/bag_topics.hpp"
#include "mms/dataset/bag/bag_truth.hpp"
#include "mms/dataset/source/frame_association.hpp"
#include "mms/ros/cloud_messages.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

constexpr Duration kMaxDifference = std::chrono::milliseconds(20);
constexpr Duration kMaxCloudDifference = std::chrono::milliseconds(50);

/// Common prefix of all messages with a stamp.
struct Stamped {
  msg::Header header;

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.header);
  }
};

/// Stamp of a message's header; the time of recording if the driver left it empty.
Timestamp stamp_of(const msg::Header& header, Timestamp received) {
  constexpr Timestamp kFirst(1);  // bags must not contain time zero
  return header.stamp == Timestamp() && received > kFirst ? received : header.stamp;
}

/// Reads the stamps of a topic, message by message.
class StreamReader {
 public:
  StreamReader(const BagReader& bag, BagStream& stream, const std::string& topic)
      : bag_(&bag), stream_(&stream) {
    stream.topic = topic;
    for (const BagTopic& candidate : bag.topics()) {
      if (candidate.name != topic) continue;
      stream.compressed = candidate.type == "sensor_msgs/CompressedImage";
      stream.livox = is_livox_type(candidate.type);
    }
  }

  bool done() const { return stream_->stamps.size() == bag_->count(stream_->topic); }
  /// Time of recording of the next message.
  Timestamp received() const { return bag_->received(stream_->topic, stream_->stamps.size()); }

  void step() {
    const Timestamp time = received();
    try {
      const auto header = bag_->read<Stamped>(stream_->topic, stream_->stamps.size()).header;
      stream_->stamps.push_back(stamp_of(header, time));
      delays_.push_back(time - stream_->stamps.back());
      if (stream_->frame_id.empty()) stream_->frame_id = header.frame_id;
    } catch (const DataError&) {  // its frame is skipped with a warning
      stream_->stamps.push_back(time);
    }
  }

  void finish() {
    if (!delays_.empty()) stream_->delay = upper_median(std::move(delays_));
  }

 private:
  const BagReader* bag_;
  BagStream* stream_;
  std::vector<Duration> delays_;
};

/// Reads the stamps of all streams in the order of recording, so that each chunk is read once.
void read_streams(std::vector<StreamReader> readers) {
  const auto earlier = [](const StreamReader& a, const StreamReader& b) {
    return !a.done() && (b.done() || a.received() < b.received());
  };
  while (true) {
    const auto next = std::min_element(readers.begin(), readers.end(), earlier);
    if (next->done()) break;
    next->step();
  }
  for (StreamReader& reader : readers) reader.finish();
}

std::string counts_of(const BagStream& stream, const std::string& what) {
  return std::to_string(stream.stamps.size()) + " " + what + " of " + stream.topic;
}

/// Assigns the nearest message of `stream` to each frame.
std::size_t match(std::vector<BagFrame>& frames, const BagStream& stream, Duration reach,
                  std::size_t BagFrame::*member) {
  std::vector<Timestamp> stamps;
  for (const BagFrame& frame : frames) stamps.push_back(frame.stamp);
  const auto pairs = associate(stamps, stream.stamps, reach);
  for (const auto& [i, j] : pairs) frames[i].*member = j;
  return pairs.size();
}

void make_rgbd_frames(BagRecording& recording, const std::string& where) {
  for (std::size_t i = 0; i < recording.color.stamps.size(); ++i) {
    recording.frames.push_back({.stamp = recording.color.stamps[i], .color = i});
  }
  const std::size_t colors = recording.frames.size();
  match(recording.frames, recording.depth, kMaxDifference, &BagFrame::depth);
  std::erase_if(recording.frames,
                [](const BagFrame& frame) { return frame.depth == BagFrame::kNone; });
  const std::string counts = counts_of(recording.color, "color images") + " and " +
                             counts_of(recording.depth, "depth images");
  if (recording.frames.empty()) {
    throw DataError(where, "of " + counts + ", no two match within 0.02 s",
                    "they begin at " + recording.color.stamps[0].to_string() + " and " +
                        recording.depth.stamps[0].to_string());
  }
  recording.facts.push_back("images: " + counts + ", " + std::to_string(recording.frames.size()) +
                            " matched within 0.02 s, " +
                            std::to_string(colors - recording.frames.size()) +
                            " color images unmatched");
}

void make_cloud_frames(BagRecording& recording) {
  for (std::size_t i = 0; i < recording.cloud.stamps.size(); ++i) {
    recording.frames.push_back({.stamp = recording.cloud.stamps[i], .cloud = i});
  }
  recording.facts.push_back("clouds: " + counts_of(recording.cloud, "clouds"));
  if (recording.color.empty()) return;
  const std::size_t found =
      match(recording.frames, recording.color, kMaxCloudDifference, &BagFrame::color);
  recording.facts.push_back("images: " + counts_of(recording.color, "color images") + ", " +
                            std::to_string(found) + " clouds have one within 0.05 s");
}

/// Label images of a folder, named as the frames.
void find_mask_files(BagRecording& recording, const fs::path& folder) {
  std::size_t found = 0;
  for (BagFrame& frame : recording.frames) {
    const fs::path file = folder / (frame.stamp.to_string() + ".png");
    if (!fs::exists(file)) continue;
    frame.mask_file = file;
    ++found;
  }
  if (found == 0) {
    throw DataError(folder.string(), "has no mask for any frame",
                    "masks are named by stamp, the first one " +
                        recording.frames.front().stamp.to_string() + ".png");
  }
  recording.facts.push_back("masks: " + std::to_string(found) + " of " +
                            std::to_string(recording.frames.size()) + " in " + folder.string());
}

void find_masks(BagRecording& recording, const SourceOptions& options) {
  if (options.load_masks && !options.masks.empty()) {
    return find_mask_files(recording, options.masks);
  }
  if (recording.mask.empty()) {
    recording.facts.emplace_back("masks: none");
    return;
  }
  // Masks have the stamps of the images they were made of, not those of clouds.
  std::vector<std::size_t> with_color;
  std::vector<Timestamp> stamps;
  for (std::size_t i = 0; i < recording.frames.size(); ++i) {
    const std::size_t color = recording.frames[i].color;
    if (color == BagFrame::kNone) continue;
    with_color.push_back(i);
    stamps.push_back(recording.color.stamps[color]);
  }
  const auto pairs = associate(stamps, recording.mask.stamps, Duration(0));
  for (const auto& [i, j] : pairs) recording.frames[with_color[i]].mask = j;
  recording.facts.push_back("masks: " + std::to_string(pairs.size()) + " of " +
                            std::to_string(recording.frames.size()) + " in " +
                            recording.mask.topic);
}

void add_topic_facts(BagRecording& recording) {
  for (const BagTopic& topic : recording.bag->topics()) {
    recording.facts.push_back("topic: " + topic.name + ", " + topic.type + ", " +
                              std::to_string(topic.count) + " messages");
  }
}

void add_choice_facts(BagRecording& recording, const BagTopicNames& topics) {
  const auto add = [&](const char* what, const std::string& topic) {
    if (!topic.empty()) recording.facts.push_back(std::string(what) + " topic: " + topic);
  };
  add("color", topics.color);
  add("depth", topics.depth);
  add("cloud", topics.cloud);
  add("camera_info", topics.camera_info);
  add("mask", topics.mask);
  add("wheels", topics.wheels);
  add("imu", topics.imu);
  add("truth", topics.truth);
}

/// Compares the clock of the stamps with that of the recorder, and with those of other topics.
void check_clocks(BagRecording& recording) {
  constexpr double kSameClock = 1.0;  // [s]
  const BagStream* first = nullptr;
  for (const BagStream* stream : {&recording.color, &recording.depth, &recording.cloud}) {
    if (stream->empty()) continue;
    if (std::abs(to_seconds(stream->delay)) > kSameClock) {
      recording.facts.push_back("clock: " + stream->topic + " was recorded " +
                                Timestamp(stream->delay.count()).to_string() +
                                " s after its stamps");
    }
    if (first == nullptr) first = stream;
    if (std::abs(to_seconds(stream->delay) - to_seconds(first->delay)) > kSameClock) {
      recording.warnings.push_back("the stamps of " + first->topic + " and " + stream->topic +
                                   " have different clocks: they were recorded " +
                                   Timestamp(first->delay.count()).to_string() + " s and " +
                                   Timestamp(stream->delay.count()).to_string() + " s later");
    }
  }
}

/// Tells by the first cloud that the times of points have another clock than the stamps.
void check_point_clock(BagRecording& recording) {
  if (recording.cloud.empty() || recording.cloud.livox) return;
  const std::string& topic = recording.cloud.topic;
  const std::string where = recording.bag->where(topic, 0);
  bool other_clock = false;
  try {
    scan_of(recording.bag->read<msg::PointCloud2>(topic, 0), recording.cloud.stamps[0], where,
            &other_clock);
  } catch (const DataError&) {  // its frame is skipped with a warning
    return;
  }
  if (!other_clock) return;
  recording.warnings.push_back("the times of points of " + topic +
                               " are more than 1 s from the stamps: each scan is taken to begin at "
                               "its stamp");
}

/// @throws DataError for options of the camera that this bag has no use for.
void check_camera_options(const CameraOptions& camera, const BagTopicNames& topics,
                          const std::string& where) {
  if (camera.intrinsics) {
    throw DataError(where, "is no folder of color and depth images",
                    "--intrinsics is for those; use --calibration");
  }
  if (camera.depth_scale && topics.depth.empty()) {
    throw DataError(where, "is read without depth images", "omit --depth-scale");
  }
}

BagTopicNames topics_of(const BagReader& bag, const BagTopicNames& given,
                        const std::string& where) {
  const auto encoding_of = [&](const BagTopic& topic) {
    if (topic.type != "sensor_msgs/CompressedImage") {
      return bag.first<msg::Image>(topic.name).encoding;
    }
    try {
      return bag.first<msg::CompressedImage>(topic.name).format;
    } catch (const DataError&) {  // its frames are skipped with a warning
      return std::string();
    }
  };
  const std::string damage = bag.damage().empty() ? "" : " (" + bag.damage().front() + ")";
  if (bag.topics().empty()) throw DataError(where, "is empty: it has no topics" + damage);
  return choose_topics(bag.topics(), given, encoding_of, where + damage);
}

}  // namespace

BagRecording read_bag_recording(const fs::path& path, const SourceOptions& options) {
  BagRecording recording;
  recording.bag = std::make_unique<BagReader>(path);
  const BagReader& bag = *recording.bag;
  const BagTopicNames topics = topics_of(bag, options.topics, path.string());
  check_camera_options(options.camera, topics, path.string());
  recording.warnings = bag.damage();
  recording.facts.push_back("layout: " + bag.layout());
  recording.facts.emplace_back(topics.cloud.empty() ? "sensor: depth camera" : "sensor: LiDAR");
  add_topic_facts(recording);
  add_choice_facts(recording, topics);
  const bool masks = options.load_masks && options.masks.empty();
  read_streams({{bag, recording.color, topics.color},
                {bag, recording.depth, topics.depth},
                {bag, recording.cloud, topics.cloud},
                {bag, recording.mask, masks ? topics.mask : ""}});
  check_clocks(recording);
  check_point_clock(recording);
  topics.cloud.empty() ? make_rgbd_frames(recording, path.string()) : make_cloud_frames(recording);
  const TransformTree transforms = read_transforms(bag, recording.warnings);
  recording.motion = read_bag_motion(bag, topics, options.motion, recording.warnings);
  const auto calibration = std::make_shared<const Calibration>(
      bag_calibration(recording, topics, transforms, path, options));
  recording.calibration = registered_calibration(calibration);
  recording.registration = make_registration(*calibration);
  find_masks(recording, options);
  if (!topics.truth.empty()) {
    const BagStream& sensor = topics.cloud.empty() ? recording.color : recording.cloud;
    recording.ground_truth =
        read_truth(bag, topics.truth, transforms, sensor.frame_id, recording.warnings);
  }
  return recording;
}

}  // namespace mms
