#include <nlohmann/json.hpp>

#include "mms/core/error.hpp"
#include "mms/dataset/camera/oni_records.hpp"
#include "mms/dataset/folder/sensor_info.hpp"
#include "mms/dataset/lidar/kitti_calibration.hpp"
#include "mms/dataset/lidar/scan_format.hpp"
#include "mms/dataset/open_dataset.hpp"
#include "mms/dataset/source/image_list.hpp"
#include "mms/io/capture/ouster_metadata.hpp"
#include "mms/io/capture/packet_capture.hpp"
#include "mms/io/capture/velodyne_calibration.hpp"
#include "mms/io/image/image_io.hpp"
#include "mms/io/text/atomic_file.hpp"
#include "mms/io/video/video_reader.hpp"
#include "mms/ros/bag/bag_files.hpp"
#include "mms/ros/bag/bag_reader.hpp"
#include "mms/ros/camera_messages.hpp"
#include "mms/ros/cloud_messages.hpp"
#include "mms/ros/image_messages.hpp"
#include "mms/ros/mask_messages.hpp"
#include "mms/ros/rvl.hpp"
#include "mms/ros/transform_tree.hpp"
#include "mms/ros2/parameter_messages.hpp"
#include "mms/ros2/service_messages.hpp"
#include "tests/dataset/capture_file.hpp"
#include "tests/dataset/video_file.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/ros/sample_bags.hpp"

namespace mms::testing {
namespace {

using Seeds = std::vector<std::string>;

Seeds bag_seeds() {
  return {bytes_of("a.bag", [](const auto& path) {
    const auto bag = create_bag(path);
    write_sample(*bag);
    bag->finish();
  })};
}

Seeds mcap_seeds() {
  MessageList list;
  write_sample(list);
  return {mcap_bytes(list.messages(), {.compression = ""}),
          mcap_bytes(list.messages(), {.compression = "lz4"}),
          mcap_bytes(list.messages(), {.compression = "zstd"}),
          mcap_bytes(list.messages(), {.chunks = false, .summary = false})};
}

Seeds db3_seeds() {
  MessageList list;
  write_sample(list);
  Seeds seeds;
  for (const bool zstd : {false, true}) {
    seeds.push_back(bytes_of("a.db3", [&](const auto& path) {
      write_db3(path, list.messages(), {.zstd_messages = zstd});
    }));
  }
  return seeds;
}

Seeds packed_seeds() {
  return {compress_zstd(mcap_seeds().front())};
}

template <class Message>
void read_messages(const BagReader& bag, const std::string& topic) {
  for (std::size_t i = 0; i < bag.count(topic); ++i) {
    try {
      bag.read<Message>(topic, i);
    } catch (const Error&) {  // a damaged message
    }
  }
}

void read_bag(const std::filesystem::path& path) {
  const BagReader bag(path);
  read_messages<msg::Image>(bag, "/image");
  read_messages<msg::PoseStamped>(bag, "/pose");
  read_messages<msg::Transforms>(bag, "/tf");
}

void read_bag_bytes(std::string_view bytes) {
  read_bag(as_file(bytes, "in.bag"));
}
void read_mcap_bytes(std::string_view bytes) {
  read_bag(as_file(bytes, "in.mcap"));
}
void read_db3_bytes(std::string_view bytes) {
  read_bag(as_file(bytes, "in.db3"));
}
void read_packed_bytes(std::string_view bytes) {
  read_bag(as_file(bytes, "in.mcap.zstd"));
}

Seeds metadata_seeds() {
  return {
      "rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: mcap\n"
      "  relative_file_paths:\n    - a_0.mcap\n  topics_with_message_count: []\n"};
}

void read_metadata_bytes(std::string_view bytes) {
  static const std::string mcap = mcap_seeds().front();
  const auto folder = fuzz_folder() / "rosbag2";
  std::filesystem::create_directories(folder);
  write_file(folder / "a_0.mcap", mcap);
  write_file(folder / "metadata.yaml", bytes);
  std::vector<std::string> warnings;
  bag_files(folder, warnings);
}

template <class Message>
void add_seeds(Seeds& seeds, const Message& message) {
  for (const msg::WireFormat format : {msg::WireFormat::kRos1, msg::WireFormat::kCdr}) {
    std::string bytes(msg::encoded_size(message, format), '\0');
    msg::encode(message, reinterpret_cast<std::uint8_t*>(bytes.data()), format);
    seeds.push_back(bytes);
  }
}

/// Seeds of all types together: the readers also get messages of other types.
Seeds message_seeds() {
  const msg::Header header{7, Timestamp(1'000'000'001), "camera"};
  Seeds seeds;
  add_seeds(seeds, image_message(header, Image<Rgb>(3, 2, Rgb{1, 2, 3})));
  add_seeds(seeds, image_message(header, Image<std::uint16_t>(3, 2, 1000)));
  add_seeds(seeds, image_message(header, Image<float>(3, 2, 1.5F)));
  add_seeds(seeds, compressed_message(header, Image<Rgb>(3, 2, Rgb{1, 2, 3}), 90));
  add_seeds(seeds, compressed_message(header, Image<std::uint16_t>(3, 2, 1000)));
  add_seeds(seeds,
            camera_info_message(
                header,
                {.fx = 500.0, .fy = 500.0, .cx = 320.0, .cy = 240.0, .width = 640, .height = 480}));
  LidarScan scan;
  scan.points = {{1.0F, 2.0F, 3.0F}, {4.0F, 5.0F, 6.0F}};
  scan.intensity = {0.5F, 0.25F};
  scan.time_offset = {0.0F, 0.01F};
  add_seeds(seeds, cloud_message(header, scan));
  msg::TransformStamped transform;
  transform.header = header;
  transform.child_frame_id = "lidar";
  add_seeds(seeds, msg::Transforms{{transform, transform}});
  msg::PoseStamped pose;
  pose.header = header;
  add_seeds(seeds, pose);
  msg::Odometry odometry;
  odometry.header = header;
  odometry.child_frame_id = "base";
  add_seeds(seeds, odometry);
  msg::Imu imu;
  imu.header = header;
  imu.angular_velocity = {0.1, 0.2, 0.3};
  add_seeds(seeds, imu);
  Segmentation masks;
  masks.width = 8;
  masks.height = 6;
  masks.instances.emplace_back().mask = Image<std::uint8_t>(3, 2, 1);
  add_seeds(seeds, masks_message(header, masks));
  add_seeds(seeds, msg::Numbered<msg::ListParametersRequest>{{1, 2}, {{"occupancy"}, 1}});
  add_seeds(seeds, msg::Numbered<msg::ListOf<msg::Parameter>>{{1, 2}, {{{"fusion.stride", {}}}}});
  return seeds;
}

/// Decodes the bytes as a message and uses it.
template <class Message, class Use>
void try_message(std::string_view bytes, msg::WireFormat format, const Use& use) {
  try {
    use(msg::decode<Message>(bytes, "input", format));
  } catch (const Error&) {  // may still be another message
  }
}

void read_message_bytes(std::string_view bytes) {
  for (const msg::WireFormat format : {msg::WireFormat::kRos1, msg::WireFormat::kCdr}) {
    const auto as_images = [](const auto& message) {
      try {
        color_of(message, "input");
      } catch (const Error&) {  // may still be depth
      }
      depth_of(message, "input");
    };
    try_message<msg::Image>(bytes, format, as_images);
    const auto unused = [](const auto&) {};
    try_message<msg::Numbered<msg::ListParametersRequest>>(bytes, format, unused);
    try_message<msg::Numbered<msg::ParameterNames>>(bytes, format, unused);
    try_message<msg::Numbered<msg::ListOf<msg::Parameter>>>(bytes, format, unused);
    try_message<msg::Image>(bytes, format, [](const auto& message) { mask_of(message, "input"); });
    try_message<msg::CompressedImage>(bytes, format, as_images);
    try_message<msg::CameraInfo>(
        bytes, format, [](const auto& message) { intrinsics_of(message, false, "input"); });
    try_message<msg::PointCloud2>(bytes, format, [](const auto& message) {
      scan_of(message, message.header.stamp, "input");
    });
    try_message<msg::Transforms>(bytes, format, [](const auto& message) {
      TransformTree tree;
      tree.add(message);
      tree.lookup("camera", "lidar", Timestamp());
      tree.stamps_above("lidar");
    });
    try_message<msg::PoseStamped>(bytes, format,
                                  [](const auto& message) { isometry_of(message.pose); });
    try_message<msg::Odometry>(bytes, format,
                               [](const auto& message) { isometry_of(message.pose); });
    try_message<msg::Imu>(bytes, format, [](const auto&) {});
    try_message<msg::Masks>(bytes, format,
                            [](const auto& message) { segmentation_of(message, 8, 6, "input"); });
  }
}

Seeds rvl_seeds() {
  return {std::string("\4\0\0\0\2\0\0\0\0\0\0\x81", 12)};
}

void read_rvl_bytes(std::string_view bytes) {
  decode_rvl({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, "input");
}

/// Packets of a VLP-16.
Seeds capture_seeds() {
  CaptureFile capture;
  for (int i = 0; i < 40; ++i) {
    std::string packet;
    for (int block = 0; block < 12; ++block) {
      put<std::uint16_t>(packet, 0xEEFF);
      put(packet, static_cast<std::uint16_t>((i * 12 + block) * 80 % 36000));
      for (int channel = 0; channel < 32; ++channel) {
        put<std::uint16_t>(packet, 5000);
        put<std::uint8_t>(packet, 10);
      }
    }
    put<std::uint32_t>(packet, 1327U * static_cast<std::uint32_t>(i));
    put<std::uint16_t>(packet, 0x2237);
    capture.add(packet, Timestamp(1'700'000'000'000'000'000 + 1'327'000 * i), 2368);
  }
  return {capture.bytes()};
}

void read_capture_bytes(std::string_view bytes) {
  const auto source = open_dataset(as_file(bytes, "in.pcap"));
  source->on_warning([](const std::string&) {});
  while (source->next()) {
  }
}

/// A recording of OpenNI2 with one node, a property and an image.
Seeds oni_seeds() {
  std::string file = "NI10";
  for (const std::uint32_t number : {0x0001'0001U, 0U, 100U, 0U, 1U}) put(file, number);
  const auto add = [&](std::uint32_t type, const std::string& fields, const std::string& payload) {
    constexpr std::size_t kHeader = 28;
    file += raw("NIR\0");
    put(file, type);
    put<std::uint32_t>(file, 1);
    put(file, static_cast<std::uint32_t>(kHeader + fields.size()));
    put(file, static_cast<std::uint32_t>(payload.size()));
    put<std::uint64_t>(file, 0);
    file += fields + payload;
  };
  add(0xD, raw("\6\0\0\0Image\0\3\0\0\0NONE\1\0\0\0") + std::string(24, '\0'), "");
  add(0x3, raw("\6\0\0\0xnFPS\0\x08\0\0\0\x1e\0\0\0\0\0\0\0"), "");
  add(0x5, raw("\3\0\0\0ab\0\2\0\0\0c\0"), "");
  add(0x9, "", "");
  add(0x8, std::string(12, '\0'), "");
  add(0xA, std::string(12, '\1'), std::string(48, '\x40'));
  add(0xB, "", "");
  return {file};
}

void read_oni_bytes(std::string_view bytes) {
  check_oni_records(as_file(bytes, "in.oni"));
}

Seeds video_seeds() {
  const std::vector<Image<Rgb>> images(3, Image<Rgb>(16, 16, Rgb{10, 200, 30}));
  const std::vector<Duration> times = {Duration(0), Duration(40'000'000), Duration(80'000'000)};
  Seeds seeds;
  const auto add = [&](const std::string& name, VideoCodec codec) {
    seeds.push_back(
        bytes_of(name, [&](const auto& path) { write_video(path, images, times, codec); }));
  };
  add("a.mkv", VideoCodec::kLossless);
  add("a.mp4", VideoCodec::kPredicted);
  add("a.avi", VideoCodec::kPredicted);
  return seeds;
}

/// The first image, a later one, and one before it.
void read_video_bytes(std::string_view bytes) {
  VideoReader video(as_file(bytes, "in.mp4"));
  const std::size_t last = video.times().size() - 1;
  for (const std::size_t index : {std::size_t{0}, last, last / 2}) {
    try {
      video.read(index);
    } catch (const Error&) {  // another may still be whole
    }
  }
}

Seeds ouster_seeds() {
  nlohmann::json json = {{"prod_line", "OS-1-16"},
                         {"lidar_mode", "512x10"},
                         {"beam_altitude_angles", std::vector<double>(16, 1.5)},
                         {"beam_azimuth_angles", std::vector<double>(16, 0.5)},
                         {"lidar_origin_to_beam_origin_mm", 15.8}};
  json["data_format"] = {{"pixels_per_column", 16},
                         {"columns_per_packet", 16},
                         {"columns_per_frame", 512},
                         {"udp_profile_lidar", "RNG19_RFL8_SIG16_NIR16"}};
  return {json.dump()};
}

void read_ouster_bytes(std::string_view bytes) {
  read_ouster_metadata(as_file(bytes, "ouster.json"));
}

Seeds velodyne_seeds() {
  std::string text = "lasers:\n";
  for (int i = 0; i < 64; ++i) {
    text +=
        "- {dist_correction: 1.2, horiz_offset_correction: 0.02, laser_id: " + std::to_string(i) +
        ", rot_correction: -0.07, vert_correction: -0.12, vert_offset_correction: 0.2}\n";
  }
  return {text};
}

void read_velodyne_bytes(std::string_view bytes) {
  read_velodyne_calibration(as_file(bytes, "velodyne.yaml"));
}

Seeds scan_seeds() {
  return {std::string(64, '\x40')};
}

void read_scan_bytes(std::string_view bytes) {
  const auto file = as_file(bytes, "in.bin");
  const ScanFormat formats[] = {{},
                                {.kind = ScanFormat::Kind::kNclt},
                                {.kind = ScanFormat::Kind::kRecords,
                                 .bytes = 20,
                                 .time = PointTime::kFloatSeconds,
                                 .time_at = 16}};
  for (const ScanFormat& format : formats) {
    try {
      read_scan(file, format);
    } catch (const Error&) {  // may be of another format
    }
  }
}

Seeds list_seeds() {
  return {"# stamp file\n1.0 rgb/1.png\n2.0 rgb/2.png\n",
          "1.0 rgb/1.png 1.01 depth/1.png\n2.0 rgb/2.png 2.01 depth/2.png\n",
          "#timestamp [ns],filename\n1403636579763555584,1403636579763555584.png\n"};
}

void read_list_bytes(std::string_view bytes) {
  std::vector<std::string> warnings;
  const auto file = as_file(bytes, "in.txt");
  try {
    read_image_list(file, warnings);
  } catch (const Error&) {  // may still have pairs
  }
  read_associations(file, warnings);
}

Seeds kitti_calibration_seeds() {
  return {
      "P0: 7 0 6 0 0 7 1 0 0 0 1 0\nP2: 7 0 6 4 0 7 1 0 0 0 1 0\n"
      "Tr: 0 -1 0 0 0 0 -1 0 1 0 0 0\n"};
}

void read_kitti_calibration_bytes(std::string_view bytes) {
  read_kitti_calibration(as_file(bytes, "calib.txt"), {});
}

Seeds sensor_info_seeds() {
  return {
      "m_colorWidth = 8\nm_colorHeight = 6\nm_depthWidth = 4\nm_depthHeight = 3\n"
      "m_depthShift = 1000\nm_calibrationColorIntrinsic = 9 0 4 0 0 9 3 0 0 0 1 0 0 0 0 1\n"
      "m_calibrationDepthIntrinsic = 5 0 2 0 5 1 0 0 1\n"
      "m_calibrationColorExtrinsic = 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n"};
}

void read_sensor_info_bytes(std::string_view bytes) {
  read_sensor_info(as_file(bytes, "info.txt"));
}

}  // namespace

std::vector<FuzzTarget> recording_targets() {
  std::vector<FuzzTarget> targets = {
      {"bag", bag_seeds, read_bag_bytes},
      {"mcap", mcap_seeds, read_mcap_bytes},
      {"db3", db3_seeds, read_db3_bytes},
      {"zstd_file", packed_seeds, read_packed_bytes},
      {"bag_metadata", metadata_seeds, read_metadata_bytes},
      {"ros_message", message_seeds, read_message_bytes},
      {"rvl", rvl_seeds, read_rvl_bytes},
      {"ouster_metadata", ouster_seeds, read_ouster_bytes},
      {"velodyne_calibration", velodyne_seeds, read_velodyne_bytes},
      {"scan", scan_seeds, read_scan_bytes},
      {"image_list", list_seeds, read_list_bytes},
      {"oni_records", oni_seeds, read_oni_bytes},
      {"kitti_calibration", kitti_calibration_seeds, read_kitti_calibration_bytes},
      {"sensor_info", sensor_info_seeds, read_sensor_info_bytes}};
  if (MMS_WITH_LIBPCAP) targets.push_back({"capture", capture_seeds, read_capture_bytes});
  if (kHasVideo) targets.push_back({"video", video_seeds, read_video_bytes});
  return targets;
}

}  // namespace mms::testing
