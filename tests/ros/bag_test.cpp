#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "mms/io/text/files.hpp"
#include "mms/ros/bag/bag_files.hpp"
#include "mms/ros/bag/bag_reader.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/ros/sample_bags.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;
using namespace testing;  // NOLINT: helpers of the tests

constexpr const char* kSampleTopics =
    "/image sensor_msgs/Image (5), /pose geometry_msgs/PoseStamped (1), /tf tf2_msgs/TFMessage (1)";

void expect_sample(const BagReader& bag) {
  EXPECT_EQ(bag.damage(), std::vector<std::string>());
  ASSERT_EQ(listed(bag.topics()), kSampleTopics);
  EXPECT_EQ(bag.count("/other"), 0U);
  EXPECT_EQ(bag.received("/image", 3), Timestamp(103));
  for (const std::size_t i : {4U, 0U, 2U}) {
    const auto image = bag.read<msg::Image>("/image", i);
    EXPECT_EQ(image.header.stamp, Timestamp(static_cast<std::int64_t>(i)));
    EXPECT_EQ(image.data, std::vector<std::uint8_t>(100, static_cast<std::uint8_t>(i)));
  }
  EXPECT_EQ(bag.read<msg::Transforms>("/tf", 0).transforms.size(), 1U);
}

std::vector<SerializedMessage> sample_messages(msg::WireFormat format = msg::WireFormat::kCdr) {
  MessageList list(format);
  write_sample(list);
  return list.messages();
}

class Bag : public ::testing::Test {
 protected:
  fs::path path(const std::string& name) const { return folder_.path() / name; }
  std::string sample(const std::string& name) const {
    const auto bag = create_bag(path(name));
    write_sample(*bag);
    bag->finish();
    return read_file(path(name));
  }
  std::string error(const std::string& name, const std::string& bytes) const {
    return message_of<DataError>([&] { BagReader reader(folder_.write(name, bytes)); });
  }

  TempFolder folder_;
};

TEST_F(Bag, RoundTrips) {
  for (const std::string name : {"a.bag", "a.mcap"}) {
    sample(name);
    expect_sample(BagReader(path(name)));
  }
}

TEST_F(Bag, ReadsDatabasesOfAllSchemas) {
  for (int schema = 1; schema <= 4; ++schema) {
    write_db3(path("a.db3"), sample_messages(), {.schema = schema});
    expect_sample(BagReader(path("a.db3")));
  }
  write_db3(path("b.db3"), sample_messages(), {.zstd_messages = true});
  expect_sample(BagReader(path("b.db3")));
  EXPECT_EQ(BagReader(path("b.db3")).layout(), "rosbag2 database");
}

TEST_F(Bag, ReadsMcapOfOtherWriters) {
  for (const std::string compression : {"", "lz4", "zstd"}) {
    for (const bool indexes : {true, false}) {
      const std::string bytes =
          mcap_bytes(sample_messages(), {.compression = compression, .indexes = indexes});
      expect_sample(BagReader(folder_.write("a.mcap", bytes)));
    }
  }
  expect_sample(
      BagReader(folder_.write("b.mcap", mcap_bytes(sample_messages(), {.chunks = false}))));
  const std::string ros1 =
      mcap_bytes(sample_messages(msg::WireFormat::kRos1), {.encoding = "ros1"});
  expect_sample(BagReader(folder_.write("c.mcap", ros1)));
}

TEST_F(Bag, ReadsCompressedFiles) {
  sample("a.mcap");
  folder_.write("b.mcap.zstd", compress_zstd(read_file(path("a.mcap"))));
  expect_sample(BagReader(path("b.mcap.zstd")));
  write_db3(path("c.db3"), sample_messages());
  folder_.write("d.db3.zstd", compress_zstd(read_file(path("c.db3"))));
  expect_sample(BagReader(path("d.db3.zstd")));
  expect_in("e.mcap.zstd: is not compressed by zstd", error("e.mcap.zstd", "MCAP"));
}

TEST_F(Bag, ReadsFoldersInOrderOfTheirFiles) {
  for (const bool metadata : {true, false}) {
    const std::string folder = metadata ? "with/" : "without/";
    std::string list = "rosbag2_bagfile_information:\n  relative_file_paths:\n";
    for (const int part : {0, 1, 2, 9, 10}) {
      MessageList messages;
      msg::PoseStamped pose;
      pose.pose.position[0] = part;
      messages.write("/pose", Timestamp(7), pose);  // of equal times, the order of files decides
      const std::string name = "x_" + std::to_string(part) + ".mcap";
      folder_.write(folder + name, mcap_bytes(messages.messages()));
      list += "    - " + name + "\n";
    }
    if (metadata) folder_.write(folder + "metadata.yaml", list);
    const BagReader bag(path(folder));
    EXPECT_EQ(bag.layout(), "MCAP, 5 files");
    EXPECT_EQ(bag.where("/pose", 3), folder.substr(0, folder.size() - 1) + ": /pose message 3");
    ASSERT_EQ(bag.count("/pose"), 5U);
    EXPECT_EQ(bag.read<msg::PoseStamped>("/pose", 3).pose.position[0], 9.0);
    EXPECT_EQ(bag.read<msg::PoseStamped>("/pose", 4).pose.position[0], 10.0);
  }
}

TEST_F(Bag, NamesMissingFilesAndSeveralRecordings) {
  folder_.write("split/x_0.mcap", mcap_bytes(sample_messages()));
  folder_.write("split/metadata.yaml",
                "rosbag2_bagfile_information:\n  relative_file_paths: [x_0.mcap, x_1.mcap]\n");
  EXPECT_EQ(BagReader(path("split")).damage(),
            std::vector<std::string>{"x_1.mcap of metadata.yaml is missing"});
  folder_.write("several/a.mcap", mcap_bytes(sample_messages()));
  folder_.write("several/b.mcap", mcap_bytes(sample_messages()));
  expect_in("several: has several recordings, a.mcap and b.mcap (choose one, as ",
            message_of<DataError>([&] { BagReader bag(path("several")); }));
}

TEST_F(Bag, NamesOtherEncodings) {
  const auto topics_of = [](const fs::path& file) { return listed(BagReader(file).topics()); };
  const std::string json = mcap_bytes(sample_messages(), {.encoding = "json"});
  expect_in("/image sensor_msgs/Image (json) (5)", topics_of(folder_.write("a.mcap", json)));
  write_db3(path("a.db3"), sample_messages(), {.encoding = "cbor"});
  expect_in("/image sensor_msgs/Image (cbor) (5)", topics_of(path("a.db3")));
}

TEST_F(Bag, RejectsMessageOfOtherType) {
  sample("a.bag");
  const BagReader bag(path("a.bag"));
  expect_in("a.bag: /pose message 0: ",
            message_of<DataError>([&] { bag.read<msg::CameraInfo>("/pose", 0); }));
}

TEST_F(Bag, LeavesNoFileWithoutFinish) {
  for (const std::string name : {"c.bag", "c.mcap"}) {
    write_sample(*create_bag(path(name)));
    EXPECT_TRUE(fs::is_empty(folder_.path()));
    expect_in("cannot be written: No such file",
              message_of<FileError>([&] { create_bag(path("no/" + name)); }));
  }
  expect_in("expected a name as x.bag or x.mcap",
            message_of<DataError>([&] { create_bag(path("c.db3")); }));
}

/// Of a file that is cut anywhere, the messages before are read.
TEST_F(Bag, ReadsUpToTheCut) {
  for (const std::string name : {"a.bag", "a.mcap"}) {
    const std::string whole = name == "a.bag" ? sample(name) : mcap_bytes(sample_messages());
    std::size_t last = 0;
    for (std::size_t size = 13; size < whole.size(); size += 3) {
      const BagReader bag(folder_.write("b" + name, whole.substr(0, size)));
      ASSERT_EQ(bag.damage().size(), 1U) << size;
      std::size_t readable = 0;
      for (; readable < bag.count("/image"); ++readable) {
        ASSERT_EQ(bag.read<msg::Image>("/image", readable).data[0], readable) << size;
      }
      ASSERT_GE(readable, last) << size;
      last = readable;
    }
    EXPECT_EQ(last, 5U);
  }
}

TEST_F(Bag, NamesWhereItIsDamaged) {
  const std::string whole = sample("a.bag");
  const BagReader cut(folder_.write("b.bag", whole.substr(0, whole.size() - 100)));
  expect_in("b.bag: is damaged or truncated at byte ", cut.damage().at(0));
  EXPECT_EQ(listed(cut.topics()), kSampleTopics);

  std::string unclosed = whole;  // as after a power cut: no index, and none announced
  constexpr std::string_view kField = "index_pos=";
  const std::size_t at = unclosed.find(kField) + kField.size();
  std::uint64_t index = 0;
  std::memcpy(&index, unclosed.data() + at, sizeof index);
  unclosed.resize(index);
  unclosed.replace(at, sizeof index, sizeof index, '\0');
  const BagReader open(folder_.write("c.bag", unclosed));
  EXPECT_EQ(listed(open.topics()), kSampleTopics);
  expect_in("c.bag: was not closed; what was written is read", open.damage().at(0));

  const std::string mcap = mcap_bytes(sample_messages(), {.summary = false});
  const BagReader half(folder_.write("d.mcap", mcap));
  EXPECT_EQ(listed(half.topics()), kSampleTopics);
  expect_in("d.mcap: was not closed", half.damage().at(0));
}

TEST_F(Bag, ChecksChecksums) {
  std::string chunk = mcap_bytes(sample_messages(), {.compression = ""});
  chunk[chunk.find("mono8")] = 'M';
  const BagReader bag(folder_.write("a.mcap", chunk));
  expect_in("its size or checksum is wrong",
            message_of<DataError>([&] { bag.read<msg::Image>("/image", 0); }));
  EXPECT_NO_THROW(bag.read<msg::Image>("/image", 4));

  std::string summary = sample("b.mcap");
  summary[summary.rfind("ros2msg")] = 'R';
  expect_in("has a damaged summary", BagReader(folder_.write("b.mcap", summary)).damage().at(0));
}

TEST_F(Bag, RejectsOtherFiles) {
  expect_in("b.bag: is empty, 0 bytes", error("b.bag", ""));
  expect_in("b.bag: is not a ROS 1 bag of version 2.0", error("b.bag", "#ROSBAG V1.2\n"));
  expect_in("b.bag: is not a ROS 1 bag of version 2.0", error("b.bag", "SQLite format 3"));
  expect_in("b.mcap: is not an MCAP file", error("b.mcap", "#ROSBAG V2.0\n"));
  expect_in("b.db3: is not a database of rosbag2", error("b.db3", "MCAP"));
  expect_in("no such file", message_of<FileError>([&] { BagReader bag(path("none.bag")); }));
}

TEST_F(Bag, RejectsOtherDatabases) {
  write_db3(path("a.db3"), sample_messages());
  std::string bytes = read_file(path("a.db3"));
  for (std::size_t at = bytes.find("messages"); at != std::string::npos;
       at = bytes.find("messages", at + 1)) {
    bytes[at] = 'M';
    bytes[at + 1] = 'M';
  }
  expect_in("b.db3: is not a recording of rosbag2: it has no tables", error("b.db3", bytes));
}

TEST(BagNames, AreRecognizedByExtension) {
  for (const char* name : {"x/a.bag", "a.bag.active", "a.mcap", "a.db3", "a.db3.zstd"}) {
    EXPECT_TRUE(is_bag_name(name)) << name;
  }
  EXPECT_FALSE(is_bag_name("bag"));
  EXPECT_FALSE(is_bag_name("a.zstd"));
  EXPECT_EQ(bag_stem("x/a.db3.zstd"), "x/a");
}

}  // namespace
}  // namespace mms
