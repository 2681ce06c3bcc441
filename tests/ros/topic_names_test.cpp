#include "mms/ros/topic_names.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"

namespace mms::msg {
namespace {

TEST(TopicNames, AreExpanded) {
  EXPECT_EQ(full_topic_name("/tf", "/robot", "slam", "--x"), "/tf");
  EXPECT_EQ(full_topic_name("image", "/robot", "slam", "--x"), "/robot/image");
  EXPECT_EQ(full_topic_name("image", "/", "slam", "--x"), "/image");
  EXPECT_EQ(full_topic_name("~/map", "/a/b", "slam", "--x"), "/a/b/slam/map");
  EXPECT_EQ(full_topic_name("~/map", "/", "slam", "--x"), "/slam/map");
}

TEST(TopicNames, RejectWhatRos2Rejects) {
  for (const char* name :
       {"", "/", "a//b", "a/", "/1a", "a b", "a-b", "a__b", "~map", "caf\xc3\xa9"}) {
    EXPECT_THROW(full_topic_name(name, "/", "slam", "--x"), ConfigError) << name;
  }
  EXPECT_THROW(check_node_name("a/b", "--node-name"), ConfigError);
  EXPECT_THROW(full_namespace("/robot/", "--namespace"), ConfigError);
}

TEST(TopicNames, NamespaceMayLackItsFirstSlash) {
  EXPECT_EQ(full_namespace("", "--namespace"), "/");
  EXPECT_EQ(full_namespace("robot", "--namespace"), "/robot");
}

TEST(TopicNames, TypesHaveNamesOfDds) {
  EXPECT_EQ(dds_type_name("sensor_msgs/Image"), "sensor_msgs::msg::dds_::Image_");
  EXPECT_EQ(dds_type_name("std_srvs/Trigger_Request", "srv"),
            "std_srvs::srv::dds_::Trigger_Request_");
}

}  // namespace
}  // namespace mms::msg
