#include "mms/ros2/discovery_info.hpp"

#include <gtest/gtest.h>

#include "mms/ros/type_hash.hpp"

namespace mms {
namespace {

template <std::size_t kGidSize>
std::string encoded(const DiscoveryInfo& info) {
  const ParticipantEntitiesInfo<kGidSize> message(info);
  std::string bytes(msg::encoded_size(message, msg::WireFormat::kCdr), '\0');
  msg::encode(message, reinterpret_cast<std::uint8_t*>(bytes.data()), msg::WireFormat::kCdr);
  return bytes;
}

DiscoveryInfo sample_info() {
  DiscoveryInfo info;
  info.participant.fill(1);
  info.node_namespace = "/";
  info.node_name = "abc";
  info.readers.resize(1);
  info.readers[0].fill(2);
  return info;
}

TEST(DiscoveryInfo, HasHashOfRos2) {
  EXPECT_EQ(
      msg::type_hash("rmw_dds_common/msg/ParticipantEntitiesInfo", DiscoveryInfo::kDefinition),
      "RIHS01_91a0593bacdcc50ea9bdcf849a938b128412cc1ea821245c663bcd26f83c295e");
}

TEST(DiscoveryInfo, IdentifiersHave16BytesSinceIron) {
  std::string expected("\0\1\0\0", 4);
  expected += std::string(16, '\1');
  expected += std::string(
      "\1\0\0\0"
      "\2\0\0\0"
      "/\0"
      "\0\0"
      "\4\0\0\0"
      "abc\0"
      "\1\0\0\0",
      24);
  expected += std::string(16, '\2');
  expected += std::string("\0\0\0\0", 4);
  EXPECT_EQ(encoded<16>(sample_info()), expected);
}

TEST(DiscoveryInfo, IdentifiersHave24BytesInHumble) {
  std::string expected("\0\1\0\0", 4);
  expected += std::string(16, '\1') + std::string(8, '\0');
  expected += std::string(
      "\1\0\0\0"
      "\2\0\0\0"
      "/\0"
      "\0\0"
      "\4\0\0\0"
      "abc\0"
      "\1\0\0\0",
      24);
  expected += std::string(16, '\2') + std::string(8, '\0');
  expected += std::string("\0\0\0\0", 4);
  EXPECT_EQ(encoded<24>(sample_info()), expected);
}

}  // namespace
}  // namespace mms
