#include "mms/run/view/sensor_views.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "mms/io/text/files.hpp"
#include "mms/ros/bag/bag_files.hpp"
#include "mms/ros/camera_messages.hpp"
#include "mms/ros/image_messages.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

constexpr int kWidth = 64;
constexpr int kHeight = 48;
const Timestamp kStamp(5'000'000'000);

/// A frame of two color cameras of the same kind: that of the left one is red, the other one green.
void write_bag(const std::filesystem::path& path) {
  const CameraIntrinsics camera{60, 60, 32, 24, kWidth, kHeight, {}};
  const msg::Header header{0, kStamp, "camera"};
  const auto bag = create_bag(path);
  for (const std::string name : {"left", "right"}) {
    const Rgb color = name == "left" ? Rgb{200, 0, 0} : Rgb{0, 200, 0};
    bag->write("/" + name + "/rgb/image", kStamp,
               image_message(header, Image<Rgb>(kWidth, kHeight, color)));
    bag->write("/" + name + "/rgb/camera_info", kStamp, camera_info_message(header, camera));
  }
  bag->write("/depth/image", kStamp, image_message(header, Image<float>(kWidth, kHeight, 1.5F)));
  bag->finish();
}

RunOptions options_of(const std::filesystem::path& bag, const std::string& camera) {
  RunOptions options;
  options.data = bag.string();
  options.segmenter = "none";
  options.topics.color = "/" + camera + "/rgb/image";
  options.topics.camera_info = "/" + camera + "/rgb/camera_info";
  return options;
}

/// The record of a run after it was written and read.
RunRecord kept_record(const TempFolder& folder, const RunOptions& options) {
  write_run_record(folder.path(), record_of(options, std::nullopt, true, 0.02),
                   RunLog({}, false, {}));
  return read_run_record(folder.path() / "run.json");
}

TEST(SensorViews, AreOfTheTopicsOfTheRun) {
  const TempFolder folder;
  const std::filesystem::path bag = folder.path() / "a.bag";
  write_bag(bag);
  FrameRecord frame;
  frame.stamp = kStamp;
  for (const std::string camera : {"left", "right"}) {
    const RunRecord record = kept_record(folder, options_of(bag, camera));
    SensorViews views(record, SystemConfig(), {frame});
    const auto view = views.load(0);
    ASSERT_TRUE(view);
    EXPECT_EQ(view->color(0, 0), camera == "left" ? (Rgb{200, 0, 0}) : (Rgb{0, 200, 0}));
  }
}

TEST(RunRecord, HasTheGivenTopicsAlone) {
  const TempFolder folder;
  RunOptions options = options_of("a.bag", "left");
  EXPECT_EQ(kept_record(folder, options).topics, options.topics);
  expect_in("\"camera_info\": \"/left/rgb/camera_info\"", read_file(folder.path() / "run.json"));
  options.topics = {};
  EXPECT_TRUE(kept_record(folder, options).topics.empty());
  EXPECT_EQ(read_file(folder.path() / "run.json").find("topics"), std::string::npos);
}

TEST(RunRecord, TopicsThatAreNoNamesAreFaults) {
  const TempFolder folder;
  kept_record(folder, options_of("a.bag", "left"));
  std::string text = read_file(folder.path() / "run.json");
  const std::string name = "\"/left/rgb/image\"";
  text.replace(text.find(name), name.size(), "7");
  folder.write("run.json", text);
  expect_in("run.json: is not a record of a run: ",
            message_of<DataError>([&] { read_run_record(folder.path() / "run.json"); }));
}

}  // namespace
}  // namespace mms
