#include "mms/ros/bag_writer.hpp"

#include <rosbag/bag.h>

#include <algorithm>

#include "mms/core/error.hpp"
#include "mms/ros/rosbag/raw_message.hpp"

namespace mms {

class BagWriter::Impl {
 public:
  explicit Impl(const std::filesystem::path& path)
      : path_(path), temporary_(path.string() + ".part") {
    const std::filesystem::path folder = path.parent_path();
    if (!folder.empty() && !std::filesystem::is_directory(folder)) {
      throw FileError(path.string(), "its folder does not exist", "create " + folder.string());
    }
    guarded([&] { bag_.open(temporary_.string(), rosbag::bagmode::Write); });
  }

  ~Impl() {
    if (finished_) return;
    try {
      bag_.close();
    } catch (const std::exception&) {  // the file is removed anyway
    }
    std::error_code ignored;
    std::filesystem::remove(temporary_, ignored);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void write(const std::string& topic, Timestamp recorded, RawMessage message) {
    ros::Time time;  // rosbag treats time zero as none
    time.fromNSec(static_cast<std::uint64_t>(std::max<std::int64_t>(1, recorded.nanoseconds())));
    guarded([&] { bag_.write(topic, time, message); });
  }

  void finish() {
    guarded([&] { bag_.close(); });
    guarded([&] { std::filesystem::rename(temporary_, path_); });
    finished_ = true;
  }

 private:
  template <class Action>
  void guarded(const Action& action) {
    try {
      action();
    } catch (const std::exception& error) {
      throw FileError(path_.string(), std::string("cannot be written: ") + error.what());
    }
  }

  std::filesystem::path path_;
  std::filesystem::path temporary_;
  rosbag::Bag bag_;
  bool finished_ = false;
};

BagWriter::BagWriter(const std::filesystem::path& path) : impl_(std::make_unique<Impl>(path)) {}
BagWriter::~BagWriter() = default;

void BagWriter::write_bytes(const std::string& topic, Timestamp recorded,
                            const msg::MessageType& type, std::string bytes) {
  impl_->write(topic, recorded, {std::move(bytes), &type});
}

void BagWriter::finish() {
  impl_->finish();
}

}  // namespace mms
