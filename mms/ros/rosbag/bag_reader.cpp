#include "mms/ros/bag_reader.hpp"

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <map>

#include "mms/core/error.hpp"
#include "mms/ros/bag_fault.hpp"
#include "mms/ros/rosbag/raw_message.hpp"

namespace mms {
namespace {

/// Opens a bag; `fail_bag` reports the fault if it cannot be opened.
void open(rosbag::Bag& bag, const std::filesystem::path& path) {
  check_bag_file(path);
  try {
    bag.open(path.string(), rosbag::bagmode::Read);
  } catch (const rosbag::BagException& error) {
    fail_bag(path, error.what());
  } catch (const std::exception& error) {
    fail_bag(path, error.what());
  }
}

}  // namespace

class BagReader::Impl {
 public:
  explicit Impl(const std::filesystem::path& path) : path_(path) {
    open(bag_, path);
    view_.addQuery(bag_);
    for (const rosbag::ConnectionInfo* connection : view_.getConnections()) {
      messages_[connection->topic];
      types_[connection->topic] = connection->datatype;
    }
    for (const rosbag::MessageInstance& message : view_) {
      messages_[message.getTopic()].push_back(message);
    }
    for (const auto& [topic, type] : types_) {
      topics_.push_back({topic, type, messages_[topic].size()});
    }
  }

  const std::vector<BagTopic>& topics() const { return topics_; }
  const std::filesystem::path& path() const { return path_; }

  const std::vector<rosbag::MessageInstance>& messages(const std::string& topic) const {
    static const std::vector<rosbag::MessageInstance> kNone;
    const auto found = messages_.find(topic);
    return found == messages_.end() ? kNone : found->second;
  }

  std::string_view bytes(const std::string& topic, std::size_t index, const std::string& where) {
    try {
      current_ = messages(topic).at(index).instantiate<RawMessage>();
    } catch (const std::exception& error) {
      throw DataError(where, std::string("cannot be read: ") + error.what());
    }
    return current_->bytes;
  }

 private:
  std::filesystem::path path_;
  rosbag::Bag bag_;
  rosbag::View view_;
  std::map<std::string, std::string> types_;
  std::map<std::string, std::vector<rosbag::MessageInstance>> messages_;
  std::vector<BagTopic> topics_;
  boost::shared_ptr<RawMessage> current_;
};

BagReader::BagReader(const std::filesystem::path& path) : impl_(std::make_unique<Impl>(path)) {}
BagReader::~BagReader() = default;

const std::vector<BagTopic>& BagReader::topics() const {
  return impl_->topics();
}

std::size_t BagReader::count(const std::string& topic) const {
  return impl_->messages(topic).size();
}

Timestamp BagReader::received(const std::string& topic, std::size_t index) const {
  const ros::Time time = impl_->messages(topic).at(index).getTime();
  return Timestamp(static_cast<std::int64_t>(time.toNSec()));
}

std::string BagReader::where(const std::string& topic, std::size_t index) const {
  return impl_->path().filename().string() + ": " + topic + " message " + std::to_string(index);
}

std::string_view BagReader::bytes(const std::string& topic, std::size_t index) const {
  return impl_->bytes(topic, index, where(topic, index));
}

}  // namespace mms
