#include "interfaces/ros1/src/slam_node.hpp"

#include <algorithm>
#include <chrono>
#include <numeric>

#include "interfaces/ros1/src/remote_image.hpp"
#include "mms/core/error.hpp"
#include "mms/ros/mask_messages.hpp"
#include "mms/run/results/result_files.hpp"
#include "mms/run/results/robot_maps.hpp"
#include "mms/run/segmenter/network_detector.hpp"
#include "mms/segmentation/segmenters/segmenter.hpp"

namespace mms {
namespace {

constexpr double kDiagnosisPeriod = 1.0;  // [s]
constexpr double kRepeat = 5.0;           // between warnings [s]

MaskExchange::Clock::duration seconds(double value) {
  return std::chrono::duration_cast<MaskExchange::Clock::duration>(
      std::chrono::duration<double>(value));
}

AsyncOptions threads_of(const NodeSettings& settings) {
  const auto cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  // With one thread the stages would run sequentially.
  return {.threads = std::max(2, settings.threads > 0 ? settings.threads : cores), .live = true};
}

msg::KeyValue value(const char* key, const auto& number) {
  std::ostringstream text;
  text << number;
  return {key, text.str()};
}

ros::TransportHints hints(bool udp) {
  ros::TransportHints hints;
  if (udp) hints.unreliable();
  return hints.reliable().tcpNoDelay();
}

}  // namespace

SlamNode::SlamNode(const NodeSettings& settings)
    : settings_(settings),
      results_(node_, settings),
      queue_(static_cast<std::size_t>(settings.queue_size)),
      exchange_(seconds(settings.mask_wait), seconds(settings.link_timeout)) {
  make_segmenter();  // reports faults in the settings at the start
  diagnostics_ = public_node_.advertise<msg::DiagnosticArray>("/diagnostics", 10);
  if (settings.masks == "remote") {
    remote_images_ = node_.advertise<msg::CompressedImage>("segmentation/image", 50);
    using Pointer = boost::shared_ptr<const msg::Masks>;
    remote_masks_ = node_.subscribe<msg::Masks>(
        "segmentation/masks", 100,
        boost::function<void(const Pointer&)>([this](const Pointer& m) { receive_masks(*m); }),
        ros::VoidConstPtr(), hints(settings.udp));
  }
  pipeline_ = std::thread([this] { run_pipeline(); });
  sensor_ = std::make_unique<SensorSubscriber>(public_node_, settings,
                                               [this](Frame frame) { take(std::move(frame)); });
  save_map_ = node_.advertiseService("save_map", &SlamNode::save_map, this);
  reset_ = node_.advertiseService("reset", &SlamNode::reset, this);
  timer_ = node_.createWallTimer(ros::WallDuration(kDiagnosisPeriod),
                                 [this](const ros::WallTimerEvent&) { diagnose(); });
}

SlamNode::~SlamNode() {
  closing_ = true;
  queue_.close();
  exchange_.close();
  changed_.notify_all();
  if (pipeline_.joinable()) pipeline_.join();
}

std::unique_ptr<Segmenter> SlamNode::make_segmenter() {
  if (settings_.masks == "network") return make_network_segmenter(settings_.system.segmentation);
  if (settings_.masks == "none") return std::make_unique<NoneSegmenter>();
  return std::make_unique<RemoteSegmenter>(exchange_);
}

void SlamNode::take(Frame frame) {
  if (last_stamp_ && frame.stamp + FrameAssembler::kMaxStepBack < *last_stamp_) {
    ROS_WARN("the clock went back: map, objects and trajectory begin again");
    exchange_.forget();
    queue_.interrupt();  // the pipeline ends, and the next one begins with this frame
  } else if (last_stamp_ && frame.stamp <= *last_stamp_) {
    ROS_WARN_THROTTLE(kRepeat, "a frame is skipped: its stamp is not later than that before");
    return;
  }
  last_stamp_ = frame.stamp;
  {
    const std::scoped_lock lock(mutex_);
    sensor_frame_ = sensor_->frame_id();
    image_width_ = frame.color.width();
    image_height_ = frame.color.height();
  }
  const bool remote = settings_.masks == "remote" && !frame.color.empty();
  if (remote && exchange_.may_send()) send_to_segmentation(frame);
  queue_.push(std::move(frame));
}

void SlamNode::send_to_segmentation(const Frame& frame) {
  const msg::Header header{static_cast<std::uint32_t>(frame.index), frame.stamp, sensor_frame_};
  exchange_.sent(frame.stamp);
  remote_images_.publish(
      remote_image(header, frame.color, settings_.remote_width, settings_.remote_quality));
}

void SlamNode::receive_masks(const msg::Masks& masks) {
  try {
    std::unique_lock lock(mutex_);
    const int width = image_width_;
    const int height = image_height_;
    lock.unlock();
    if (width == 0) return;  // masks of an earlier run of this node
    exchange_.received(masks.header.stamp, segmentation_of(masks, width, height, "masks"));
  } catch (const Error& error) {
    ROS_WARN_THROTTLE(kRepeat, "masks from the segmentation node: %s", error.what());
  }
}

void SlamNode::run_pipeline() {
  while (!closing_) {
    try {
      SlamSystem system(settings_.system, make_segmenter());
      {
        const std::scoped_lock lock(mutex_);
        system_ = &system;
        resetting_ = false;
      }
      changed_.notify_all();
      AsyncPipeline pipeline(threads_of(settings_));
      pipeline.run(
          system, [this] { return next_frame(); },
          [&](const Processed& processed) { finish_frame(processed, system); });
    } catch (const std::exception& error) {
      ROS_ERROR("the pipeline restarts: %s", error.what());
    }
    const std::scoped_lock lock(mutex_);
    system_ = nullptr;
    in_flight_ = 0;
    trajectory_.clear();
    keyframes_.clear();
    results_.reset();
  }
}

std::optional<Frame> SlamNode::next_frame() {
  std::optional<Frame> frame = queue_.pop();
  if (!frame) return std::nullopt;
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !paused_ || closing_; });
  ++in_flight_;
  return frame;
}

void SlamNode::finish_frame(const Processed& processed, const SlamSystem& system) {
  std::string sensor_frame;
  {
    const std::scoped_lock lock(mutex_);
    const OdometryEstimate& odometry = processed.result.odometry;
    trajectory_.push_back({processed.frame.stamp, odometry.T_world_sensor});
    if (processed.result.keyframe) keyframes_.push_back(trajectory_.back());
    if (odometry.status == Status::kLost) ++lost_;
    ++processed_;
    const StageTimes& times = processed.result.stage_ms;
    frame_ms_ = std::accumulate(times.begin() + 1, times.end(), 0.0);
    sensor_frame = sensor_frame_;
  }
  results_.publish(processed, system, sensor_frame);
  const std::scoped_lock lock(mutex_);
  --in_flight_;
  changed_.notify_all();
}

/// Runs `task` between two frames.
/// @returns false if there is no system.
bool SlamNode::between_frames(const Task& task) {
  std::unique_lock lock(mutex_);
  paused_ = true;
  changed_.wait(lock, [this] { return in_flight_ == 0 || closing_; });
  const bool ready = system_ != nullptr && !closing_;
  if (ready) task(*system_);
  paused_ = false;
  changed_.notify_all();
  return ready;
}

bool SlamNode::save_map(TriggerRequest&, TriggerResponse& response) {
  const std::filesystem::path folder = settings_.results;
  try {
    const bool done = between_frames([&](const SlamSystem& system) {
      if (trajectory_.empty()) throw DataError("map", "no frame received yet");
      const bool is_depth = settings_.sensor == FrameAssembler::Sensor::kDepth;
      const MapFrame frame = is_depth ? MapFrame::kCamera : MapFrame::kLidar;
      const MapCloud map = result_map(system.static_map(), frame);
      std::filesystem::create_directories(folder);
      write_result_files(folder, trajectory_, keyframes_, map, frame);
      write_robot_maps(folder, system.occupancy_map(), system.static_map().cloud(), is_depth);
      response.message = std::to_string(map.size()) + " points, " +
                         std::to_string(trajectory_.size()) + " poses in " +
                         std::filesystem::absolute(folder).string();
    });
    response.success = done;
    if (!done) response.message = "the system is starting";
  } catch (const std::exception& error) {
    response.success = false;
    response.message = error.what();
    const std::scoped_lock lock(mutex_);
    paused_ = false;
    changed_.notify_all();
  }
  return true;
}

bool SlamNode::reset(TriggerRequest&, TriggerResponse& response) {
  {
    const std::scoped_lock lock(mutex_);
    resetting_ = true;
  }
  queue_.interrupt();
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !resetting_ || closing_; });
  response.success = !closing_;
  response.message = "map, objects and trajectory restart with the next frame";
  return true;
}

void SlamNode::diagnose() {
  const std::string inputs = sensor_->report(kDiagnosisPeriod);
  const std::size_t unmatched = sensor_->unmatched();
  const std::size_t damaged = sensor_->damaged();
  const MaskExchange::Counts masks = exchange_.counts();
  msg::DiagnosticStatus status;
  const std::scoped_lock lock(mutex_);
  const std::size_t frames = processed_ - reported_;
  reported_ = processed_;
  status.name = node_.getNamespace() + ": frames";
  status.message = frames > 0 ? "localising" : "no frames: " + inputs;
  if (frames == 0) status.level = msg::DiagnosticStatus::kWarn;
  if (frames == 0 && in_flight_ == 0) ROS_WARN_THROTTLE(kRepeat, "no frames: %s", inputs.c_str());
  if (settings_.masks == "remote" && masks.link_lost != link_was_lost_) {
    link_was_lost_ = masks.link_lost;
    if (masks.link_lost) {
      ROS_WARN(
          "no masks for %.1f s: the link to the segmentation node counts as lost, frames are "
          "processed without masks",
          settings_.link_timeout);
    } else {
      ROS_INFO("masks are received again");
    }
  }
  if (masks.link_lost) {
    status.level = msg::DiagnosticStatus::kError;
    status.message += "; the link to the segmentation node is lost";
  }
  status.values = {value("frames/s", static_cast<double>(frames) / kDiagnosisPeriod),
                   value("frames", processed_),
                   value("frames lost", lost_),
                   value("frames dropped", queue_.dropped()),
                   value("images unmatched", unmatched),
                   value("messages damaged", damaged),
                   value("ms/frame", frame_ms_),
                   value("inputs", inputs)};
  if (settings_.masks == "remote") {
    for (const auto& entry :
         {value("masks used", masks.used), value("masks late", masks.late),
          value("masks missing", masks.missing), value("mask delay [ms]", masks.delay_ms)}) {
      status.values.push_back(entry);
    }
  }
  const ros::Time now = ros::Time::now();
  const Timestamp stamp(static_cast<std::int64_t>(now.toNSec()));
  diagnostics_.publish(msg::DiagnosticArray{{0, stamp, ""}, {status}});
}

}  // namespace mms
