#include <ros/ros.h>

#include <exception>
#include <memory>

#include "interfaces/ros1/src/node_settings.hpp"
#include "interfaces/ros1/src/ros_traits.hpp"
#include "mms/core/error.hpp"
#include "mms/ros/image_messages.hpp"
#include "mms/ros/mask_messages.hpp"
#include "mms/run/segmenter/network_detector.hpp"

namespace mms {
namespace {

/// Segments people and vehicles in the images of a SLAM node, possibly on another host, and returns
/// the masks with the image's stamp. A lossy link may deliver several images at the same time: a
/// few are queued, older ones are dropped.
class SegmentationNode {
  static constexpr std::uint32_t kQueueSize = 30;

 public:
  SegmentationNode()
      : segmenter_(make_network_segmenter(load_system_config(ros::NodeHandle("~")).segmentation)) {
    Frame usual;  // the network prepares its kernels with the first image, before real ones arrive
    usual.color = Image<Rgb>(640, 480);
    segmenter_->segment(usual);
    ros::NodeHandle node("~");
    std::string transport = "tcp";
    node.getParam("mask_transport", transport);
    masks_ = node.advertise<msg::Masks>("masks", 100);
    ros::TransportHints hints;
    if (transport == "udp") hints.unreliable();
    using Pointer = boost::shared_ptr<const msg::CompressedImage>;
    images_ = node.subscribe<msg::CompressedImage>(
        "image", kQueueSize,
        boost::function<void(const Pointer&)>([this](const Pointer& image) { segment(*image); }),
        ros::VoidConstPtr(), hints.reliable().tcpNoDelay());
    ROS_INFO("segmenting images of %s", images_.getTopic().c_str());
  }

 private:
  void segment(const msg::CompressedImage& image) {
    try {
      Frame frame;
      frame.stamp = image.header.stamp;
      frame.color = color_of(image, "image");
      masks_.publish(masks_message(image.header, segmenter_->segment(frame)));
    } catch (const Error& error) {
      ROS_WARN_THROTTLE(5.0, "%s", error.what());
    }
  }

  std::unique_ptr<Segmenter> segmenter_;
  ros::Publisher masks_;
  ros::Subscriber images_;
};

}  // namespace
}  // namespace mms

int main(int argc, char** argv) {
  ros::init(argc, argv, "mms_segmentation");
  try {
    mms::SegmentationNode node;
    ros::spin();
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}
