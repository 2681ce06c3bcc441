#include "mms/core/error.hpp"
#include "mms/io/cloud/kitti_io.hpp"
#include "mms/io/cloud/pcd_io.hpp"
#include "mms/io/cloud/ply_io.hpp"
#include "mms/io/config/calibration_formats.hpp"
#include "mms/io/config/calibration_io.hpp"
#include "mms/io/config/camera_json.hpp"
#include "mms/io/config/config_assignments.hpp"
#include "mms/io/config/config_yaml.hpp"
#include "mms/io/image/coco_io.hpp"
#include "mms/io/image/image_io.hpp"
#include "mms/io/image/npy_io.hpp"
#include "mms/io/journal/journal.hpp"
#include "mms/io/journal/journal_reader.hpp"
#include "mms/io/journal/journal_record.hpp"
#include "mms/io/motion/motion_io.hpp"
#include "mms/io/results/objects_io.hpp"
#include "mms/io/results/occupancy_grid_io.hpp"
#include "mms/io/results/trajectory_io.hpp"
#include "mms/io/text/atomic_file.hpp"
#include "mms/io/weights/safetensors.hpp"
#include "mms/simulation/config/scene_config.hpp"
#include "tests/fuzz/fuzz_target.hpp"

namespace mms::testing {
namespace {

using Seeds = std::vector<std::string>;

PointCloudFile two_points() {
  PointCloudFile cloud;
  cloud.points = {{1.0F, 2.0F, 3.0F}, {4.0F, 5.0F, 6.0F}};
  cloud.normals = {{0.0F, 0.0F, 1.0F}, {1.0F, 0.0F, 0.0F}};
  cloud.colors = {{1, 2, 3}, {4, 5, 6}};
  cloud.labels = {0, 7};
  cloud.observations = {3, 4};
  return cloud;
}

Seeds ply_seeds() {
  return {bytes_of("a.ply", [](const auto& path) { write_ply(path, two_points(), {"units: m"}); }),
          "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double y\n"
          "property double z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
          "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
          "1 2 3 10 20 30\n-1.5 nan 1e30 0 0 255\n3 0 1 1\n"};
}

void read_ply_bytes(std::string_view bytes) {
  PointCloudFile cloud = read_ply(as_file(bytes, "in.ply"));
  remove_invalid_points(cloud);
  write_ply(fuzz_folder() / "out.ply", cloud);
}

Seeds pcd_seeds() {
  const std::string head = "VERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F F\n";
  // 24 bytes as literals, then 36 as four literals and their repetition.
  const std::string compressed = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS ";
  return {bytes_of("a.pcd", [](const auto& path) { write_pcd(path, two_points()); }),
          head + "COUNT 1 1 1 1\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA ascii\n1 2 3 4e-39\nnan 1 1 0\n",
          compressed + "2\nDATA binary_compressed\n" + raw("\x19\0\0\0\x18\0\0\0\x17") +
              std::string(24, '\x3f'),
          compressed + "3\nDATA binary_compressed\n" +
              raw("\x08\0\0\0\x24\0\0\0\3\0\0\x80\x3f\xe0\x17\3")};
}

void read_pcd_bytes(std::string_view bytes) {
  PointCloudFile cloud = read_pcd(as_file(bytes, "in.pcd"));
  remove_invalid_points(cloud);
  write_pcd(fuzz_folder() / "out.pcd", cloud);
}

Trajectory two_poses() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.rotate(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitY()));
  return {{Timestamp(1'000'000'000), Transform<World, Sensor>()},
          {Timestamp(1'100'000'000), Transform<World, Sensor>(pose)}};
}

Seeds trajectory_seeds() {
  return {
      bytes_of("a.tum", [](const auto& path) { write_trajectory_tum(path, two_poses()); }),
      bytes_of("a.txt", [](const auto& path) { write_trajectory_kitti(path, two_poses()); }),
  };
}

void read_trajectory_bytes(std::string_view bytes) {
  read_trajectory(as_file(bytes, "in.txt"));
}

Seeds times_seeds() {
  return {bytes_of("times.bin", [](const auto& path) { write_point_times(path, {0.0F, 0.1F}); })};
}

Seeds motion_seeds() {
  return {bytes_of("wheels.csv",
                   [](const auto& path) {
                     write_wheels(path, std::vector<WheelSample>{{Timestamp(1'000'000'000), {}},
                                                                 {Timestamp(1'100'000'000), {}}});
                   }),
          bytes_of("imu.csv",
                   [](const auto& path) {
                     write_imu(path,
                               std::vector<ImuSample>{
                                   {Timestamp(1'000'000'000), {0.1, 0.2, 0.3}, {0.0, 0.0, 9.81}}});
                   }),
          "# stamp x y yaw\n1.0,0.5,0.25,3.1\n1.1,0.5,0.25,-3.1\n"};
}

void read_motion_bytes(std::string_view bytes) {
  const auto file = as_file(bytes, "motion.csv");
  MotionSamples samples;
  try {
    samples.wheels = read_wheels(file);
  } catch (const Error&) {  // may still be a gyroscope's
  }
  if (samples.wheels.empty()) samples.imu = read_imu(file);
  faults_of(samples, "input");
}

void read_times_bytes(std::string_view bytes) {
  read_point_times(as_file(bytes, "times.bin"));
}

Seeds settings_seeds() {
  return {dump_config(SceneConfig{}), "mask_errors:\n  missed: 0.5\nname: crowd\nseed: 3\n"};
}

void read_settings_bytes(std::string_view bytes) {
  SceneConfig config;
  try {
    assign(config, std::vector<std::string>{std::string(bytes.substr(0, 200))}, "--set");
  } catch (const Error&) {  // may still be a file
  }
  load_config(as_file(bytes, "in.yaml"), config);
}

Seeds calibration_seeds() {
  Calibration calibration;
  calibration.camera = CameraIntrinsics{
      .fx = 500.0, .fy = 500.0, .cx = 320.0, .cy = 240.0, .width = 640, .height = 480};
  return {
      bytes_of("a.yaml", [&](const auto& path) { write_calibration(path, calibration); }),
      "image_width: 640\nimage_height: 480\ndistortion_model: plumb_bob\ncamera_matrix:\n  rows: "
      "3\n"
      "  cols: 3\n  data: [500, 0, 320, 0, 500, 240, 0, 0, 1]\ndistortion_coefficients:\n"
      "  rows: 1\n  cols: 5\n  data: [0.1, 0, 0, 0, 0]\n",
      "cam0:\n  camera_model: pinhole\n  intrinsics: [500, 500, 320, 240]\n"
      "  distortion_model: radtan\n  distortion_coeffs: [0.1, 0, 0, 0]\n"
      "  resolution: [640, 480]\n",
      "%YAML:1.0\nCamera.type: \"PinHole\"\nCamera.fx: 500\nCamera.fy: 500\nCamera.cx: 320\n"
      "Camera.cy: 240\nCamera.width: 640\nCamera.height: 480\nDepthMapFactor: 1000.0\n",
      "sensor_type: camera\nT_BS:\n  cols: 4\n  rows: 4\n"
      "  data: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]\nresolution: [752, 480]\n"
      "camera_model: pinhole\nintrinsics: [458.654, 457.296, 367.215, 248.375]\n"
      "distortion_model: radial-tangential\ndistortion_coefficients: [-0.28, 0.07, 0, 0]\n",
      R"({"width": 640, "height": 480, "intrinsic_matrix": [500, 0, 0, 0, 500, 0, 320, 240, 1]})",
  };
}

void read_calibration_bytes(std::string_view bytes) {
  read_any_calibration(as_file(bytes, bytes.starts_with('{') ? "in.json" : "in.yaml"));
}

Seeds posed_camera_seeds() {
  return {R"({"frame_000010": {"intrinsic": [[500, 0, 320], [0, 500, 240], [0, 0, 1]], )"
          R"("aligned_pose": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}})"};
}

void read_posed_camera_bytes(std::string_view bytes) {
  read_posed_cameras(as_file(bytes, "in.json"));
}

Image<std::uint8_t> disc() {
  Image<std::uint8_t> mask(8, 6);
  for (int y = 2; y < 5; ++y) {
    for (int x = 1; x < 4; ++x) mask(x, y) = 1;
  }
  return mask;
}

Seeds coco_seeds() {
  CocoDataset dataset;
  dataset.images = {{.id = 1, .file_name = "a.png", .width = 8, .height = 6}};
  dataset.categories = {{1, "person"}};
  dataset.annotations = {coco_annotation(1, 1, 1, encode_rle(disc()))};
  return {
      bytes_of("a.json", [&](const auto& path) { write_coco(path, dataset); }),
      R"({"images": [{"id": 1, "file_name": "a", "width": 8, "height": 6}], "categories": )"
      R"([{"id": 1, "name": "car"}], "annotations": [{"id": 1, "image_id": 1, "category_id": 1, )"
      R"("bbox": [1, 1, 3, 3], "area": 9, "iscrowd": 0, "segmentation": [[1, 1, 4, 1, 4, 4]]}, )"
      R"({"id": 2, "image_id": 1, "category_id": 1, "bbox": [1, 1, 3, 3], "area": 9, )"
      R"("iscrowd": 1, "segmentation": {"size": [6, 8], "counts": [0, 40, 8]}}]})"};
}

void read_coco_bytes(std::string_view bytes) {
  const auto file = as_file(bytes, "in.json");
  CocoFaults faults;
  for (const CocoAnnotation& annotation : read_coco(file, faults).annotations) {
    decode_rle(annotation.segmentation);
  }
  read_coco(file);
}

Seeds coco_result_seeds() {
  return {bytes_of("a.json", [](const auto& path) {
    write_coco_results(path, {{1, 1, 0.5, encode_rle(disc())}});
  })};
}

void read_coco_result_bytes(std::string_view bytes) {
  for (const CocoResult& result : read_coco_results(as_file(bytes, "in.json"))) {
    decode_rle(result.segmentation);
  }
}

Seeds rle_seeds() {
  return {rle_to_string(encode_rle(disc()))};
}

void read_rle_bytes(std::string_view bytes) {
  const Rle rle = rle_from_string(bytes, 8, 6);
  decode_rle(rle);
  rle_box(rle);
}

Seeds safetensors_seeds() {
  Weights weights;
  weights.tensors["layer.weight"] = {{2, 2}, {1.0F, 2.0F, 3.0F, 4.0F}};
  weights.tensors["layer.bias"] = {{2}, {0.5F, -0.5F}};
  weights.metadata["note"] = "none";
  Seeds seeds;
  for (const TensorType type : {TensorType::kFloat32, TensorType::kFloat16, TensorType::kInt8}) {
    const auto bytes = encode_safetensors(weights, type, "seed");
    seeds.emplace_back(bytes.begin(), bytes.end());
  }
  return seeds;
}

void read_safetensors_bytes(std::string_view bytes) {
  parse_safetensors({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, "input");
}

Seeds journal_seeds() {
  MapChanges changes;
  changes.voxel_size = 0.02;
  changes.blocks = {{{-3, 1, 7}, 2, 1}, {{1, 2, 3}, 3, 0}};
  changes.voxels = {{511, 4, {1, 2, 3}, {-127, 0, 127}, {9, 8, 7}}};
  changes.erased = {{-1, -2, -3}};
  JournalFrame frame;
  frame.stamp = Timestamp(1'000'000'000);
  frame.keyframe = true;
  frame.map = changes;
  std::string bytes = encode_header({"a recording", 0.02, 2});
  bytes += encode_frame(frame);
  frame.map.reset();
  bytes += encode_frame(frame);
  return {bytes};
}

void read_journal_bytes(std::string_view bytes) {
  JournalReader reader(as_file(bytes, "in.bin"));
  while (reader.next()) {
  }
}

Seeds journal_record_seeds() {
  JournalFrame frame;
  frame.map.emplace().voxel_size = 0.02;
  const std::string header = encode_header({"a recording", 0.02, 2});
  const auto payload = [](const std::string& record, std::size_t begin) {
    return record.substr(begin, record.size() - begin - kRecordEnd);
  };
  return {payload(header, kJournalMagic.size() + kRecordStart),
          payload(encode_frame(frame), kRecordStart)};
}

void read_journal_record_bytes(std::string_view bytes) {
  try {
    decode_frame(bytes, "input");
  } catch (const Error&) {  // may still be a header
    decode_header(bytes, "input");
  }
}

std::string text_of(const std::vector<std::uint8_t>& bytes) {
  return {bytes.begin(), bytes.end()};
}

Seeds image_seeds() {
  Image<Rgb> color(5, 4, Rgb{10, 20, 30});
  std::string bmp(
      "BM\x46\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\2\0\0\0\2\0\0\0\1\0\x18\0\0\0\0\0\x10\0\0\0", 38);
  bmp += std::string(16, '\0') + std::string(16, '\x40');
  return {text_of(encode_png(color)),
          text_of(encode_jpeg(color)),
          text_of(encode_png(Image<std::uint16_t>(5, 4, 1000))),
          text_of(encode_png(disc())),
          bmp,
          "Pf\n5 4\n-1.0\n" + std::string(80, '\1'),
          "P5\n# a\n5 4\n65535\n" + std::string(40, '\1'),
          raw("II*\0\x08\0\0\0\4\0\0\1\3\0\1\0\0\0\2\0\0\0\1\1\3\0\1\0\0\0\2\0\0\0\x11\1\4\0\1"
              "\0\0\0\0\0\0\0\x17\1\4\0\1\0\0\0\4\0\0\0\0\0\0\0"),
          raw("RIFF\x1a\0\0\0WEBPVP8L\x0d\0\0\0\x2f\4\xc0\0\0\0\0\0\0\0\0\0\0\0"),
          raw("\x76\x2f\x31\x01\2\0\0\0channels\0chlist\0\x13\0\0\0R\0\1\0\0\0\0\0\0\0\1\0\0\0"
              "\1\0\0\0\0dataWindow\0box2i\0\x10\0\0\0\0\0\0\0\0\0\0\0\4\0\0\0\3\0\0\0\0")};
}

void read_image_bytes(std::string_view bytes) {
  const std::span<const std::uint8_t> given(reinterpret_cast<const std::uint8_t*>(bytes.data()),
                                            bytes.size());
  try {
    decode_color(given, "input");
  } catch (const Error&) {  // may still be depth
  }
  read_stored_depth(as_file(bytes, "in.png"));
}

Seeds npy_seeds() {
  const auto array = [](const std::string& type, std::size_t bytes) {
    std::string header = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (2, 3), }";
    header.resize(117, ' ');
    return std::string("\x93NUMPY\1\0\x76\0", 10) + header + '\n' + std::string(6 * bytes, '\0');
  };
  return {array("<f4", 4), array("<f8", 8), array("<u2", 2)};
}

void read_npy_bytes(std::string_view bytes) {
  read_npy(as_file(bytes, "in.npy"));
}

Seeds objects_seeds() {
  ObjectBox box;
  box.id = 3;
  box.size = {0.6, 0.5, 1.75};
  return {objects_json({{Timestamp(1'500'000'000), {box}}}),
          R"({"frames": [{"stamp": "1.500000000", "objects": [{"id": 2, "class": "agv", )"
          R"("position": [1, 2, 3], "quaternion": [0, 0, 0, 1], "size": [1, 1, 2], )"
          R"("velocity": [0, 0, 0.5], "moving": true, "visible": 0.5}]}]})"};
}

void read_objects_bytes(std::string_view bytes) {
  const auto file = as_file(bytes, "in.json");
  try {
    read_objects_truth(file);
  } catch (const Error&) {  // may still be those of a run
  }
  read_objects(file);
}

Seeds grid_seeds() {
  return {bytes_of("map.yaml", [](const auto& path) { write_occupancy_grid(path, {}); })};
}

void read_grid_bytes(std::string_view bytes) {
  read_map_frame(as_file(bytes, "in.yaml"));
}

}  // namespace

std::vector<FuzzTarget> file_targets() {
  return {{"ply", ply_seeds, read_ply_bytes},
          {"pcd", pcd_seeds, read_pcd_bytes},
          {"trajectory", trajectory_seeds, read_trajectory_bytes},
          {"point_times", times_seeds, read_times_bytes},
          {"motion", motion_seeds, read_motion_bytes},
          {"settings", settings_seeds, read_settings_bytes},
          {"calibration", calibration_seeds, read_calibration_bytes},
          {"posed_cameras", posed_camera_seeds, read_posed_camera_bytes},
          {"coco", coco_seeds, read_coco_bytes},
          {"coco_results", coco_result_seeds, read_coco_result_bytes},
          {"rle", rle_seeds, read_rle_bytes},
          {"safetensors", safetensors_seeds, read_safetensors_bytes},
          {"journal", journal_seeds, read_journal_bytes},
          {"journal_record", journal_record_seeds, read_journal_record_bytes},
          {"image", image_seeds, read_image_bytes},
          {"npy", npy_seeds, read_npy_bytes},
          {"objects", objects_seeds, read_objects_bytes},
          {"map_frame", grid_seeds, read_grid_bytes}};
}

}  // namespace mms::testing
