#include "mms/ros/type_hash.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "mms/ros/message_types.hpp"

namespace mms::msg {
namespace {

std::string hash_of(const std::string& package, const std::string& name) {
  return type_hash(package + "/msg/" + name, message_type(package + "/" + name).ros2_definition);
}

TEST(TypeHash, Sha256OfStandard) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  // Two blocks, the second of padding alone.
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

// The values that nodes of Jazzy show in ros2 topic info --verbose.
TEST(TypeHash, IsThatOfRos2) {
  EXPECT_EQ(type_hash("std_msgs/msg/String", "string data\n"),
            "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18");
  EXPECT_EQ(hash_of("sensor_msgs", "Image"),
            "RIHS01_d31d41a9a4c4bc8eae9be757b0beed306564f7526c88ea6a4588fb9582527d47");
  EXPECT_EQ(hash_of("sensor_msgs", "CompressedImage"),
            "RIHS01_15640771531571185e2efc8a100baf923961a4d15d5569652e6cb6691e8e371a");
  EXPECT_EQ(hash_of("sensor_msgs", "CameraInfo"),
            "RIHS01_b3dfd68ff46c9d56c80fd3bd4ed22c7a4ddce8c8348f2f59c299e73118e7e275");
  EXPECT_EQ(hash_of("sensor_msgs", "PointCloud2"),
            "RIHS01_9198cabf7da3796ae6fe19c4cb3bdd3525492988c70522628af5daa124bae2b5");
  EXPECT_EQ(hash_of("sensor_msgs", "Imu"),
            "RIHS01_7d9a00ff131080897a5ec7e26e315954b8eae3353c3f995c55faf71574000b5b");
  EXPECT_EQ(hash_of("nav_msgs", "Odometry"),
            "RIHS01_3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0");
  EXPECT_EQ(hash_of("nav_msgs", "Path"),
            "RIHS01_1957a5bb3cee5da65c4e52e52b65a93df227efce4c20f8458b36e73066ca334b");
  EXPECT_EQ(hash_of("tf2_msgs", "TFMessage"),
            "RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087");
  EXPECT_EQ(hash_of("visualization_msgs", "MarkerArray"),
            "RIHS01_86cb8800b6fb05b5eff1abd7a56f62a5641d3ae9a1c29e78e67e704f1d067dcf");
  EXPECT_EQ(hash_of("diagnostic_msgs", "DiagnosticArray"),
            "RIHS01_5a8a36efb05fb25070fa0fb3810290c0e6cd4862b54a8fb975a1ee8dc55a333e");
}

TEST(TypeHash, RejectsWhatIsNoDefinition) {
  EXPECT_THROW(type_hash("a/msg/B", "nonsense\n"), std::invalid_argument);
  EXPECT_THROW(type_hash("a/msg/B", "Missing c\n"), std::invalid_argument);
}

}  // namespace
}  // namespace mms::msg
