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

/// Finds people and vehicles in the images of a SLAM node, perhaps on another host, and sends their
/// masks back under the image's stamp. A link that loses packets lets go of several images at once:
/// a few wait for their turn, the oldest of more are left out.
class SegmentationNode {
  static constexpr std::uint32_t kWaiting = 30;

 public:
  SegmentationNode()
      : segmenter_(make_network_segmenter(load_system_config(ros::NodeHandle("~")).segmentation)) {
    Frame usual;  // the network plans its work at its first image, which would keep one waiting
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
        "image", kWaiting,
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
