#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mms/ros/wire.hpp"

namespace mms {

/// The identifier of a participant or endpoint in DDS.
using DdsGuid = std::array<std::uint8_t, 16>;

/// What `ros2 node list` and `ros2 node info` show of a node.
struct DiscoveryInfo {
  static constexpr std::string_view kTypeName = "rmw_dds_common/ParticipantEntitiesInfo";
  /// Of Iron and later; Humble's Gid is uint8[24], but has no hash.
  static constexpr std::string_view kDefinition =
      "Gid gid\nNodeEntitiesInfo[] node_entities_info_seq\n"
      "MSG: rmw_dds_common/Gid\nuint8[16] data\n"
      "MSG: rmw_dds_common/NodeEntitiesInfo\nstring<=256 node_namespace\nstring<=256 node_name\n"
      "Gid[] reader_gid_seq\nGid[] writer_gid_seq\n";

  DdsGuid participant{};
  std::string node_namespace;
  std::string node_name;
  std::vector<DdsGuid> readers;
  std::vector<DdsGuid> writers;
};

/// rmw_dds_common/msg/ParticipantEntitiesInfo of one node.
/// @tparam kGidSize  24 up to Humble, then 16
template <std::size_t kGidSize>
struct ParticipantEntitiesInfo {
  struct Gid {
    std::array<std::uint8_t, kGidSize> data{};

    template <class Self, class Archive>
    static void fields(Self& self, Archive& archive) {
      archive(self.data);
    }
  };

  struct Node {
    std::string name_space, name;
    std::vector<Gid> readers, writers;

    template <class Self, class Archive>
    static void fields(Self& self, Archive& archive) {
      archive(self.name_space, self.name, self.readers, self.writers);
    }
  };

  Gid participant;
  std::vector<Node> nodes;

  explicit ParticipantEntitiesInfo(const DiscoveryInfo& info)
      : participant(gid(info.participant)),
        nodes{{info.node_namespace, info.node_name, gids(info.readers), gids(info.writers)}} {}
  ParticipantEntitiesInfo() = default;

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.participant, self.nodes);
  }

 private:
  static Gid gid(const DdsGuid& guid) {
    Gid result;
    std::copy(guid.begin(), guid.end(), result.data.begin());
    return result;
  }
  static std::vector<Gid> gids(const std::vector<DdsGuid>& guids) {
    std::vector<Gid> result;
    for (const DdsGuid& guid : guids) result.push_back(gid(guid));
    return result;
  }
};

}  // namespace mms
