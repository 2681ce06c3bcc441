#include "mms/core/error.hpp"
#include "mms/ros/bag_reader.hpp"
#include "mms/ros/bag_writer.hpp"

// Replaces bag_reader.cpp and bag_writer.cpp if librosbag-storage-dev is missing.

namespace mms {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path) {
  throw FileError(path.string(), "is a bag, but mms was built without rosbag",
                  "install librosbag-storage-dev, run cmake again and build");
}

}  // namespace

class BagReader::Impl {};
class BagWriter::Impl {};

BagReader::BagReader(const std::filesystem::path& path) {
  fail(path);
}
BagReader::~BagReader() = default;
const std::vector<BagTopic>& BagReader::topics() const {
  static const std::vector<BagTopic> kNone;
  return kNone;
}
std::size_t BagReader::count(const std::string&) const {
  return 0;
}
Timestamp BagReader::received(const std::string&, std::size_t) const {
  return {};
}
std::string BagReader::where(const std::string& topic, std::size_t) const {
  return topic;
}
std::string_view BagReader::bytes(const std::string&, std::size_t) const {
  return {};
}

BagWriter::BagWriter(const std::filesystem::path& path) {
  fail(path);
}
BagWriter::~BagWriter() = default;
void BagWriter::write_bytes(const std::string&, Timestamp, const msg::MessageType&, std::string) {}
void BagWriter::finish() {}

}  // namespace mms
