#include "mms/run/record/frame_log.hpp"

#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "mms/io/journal/byte_reader.hpp"

namespace mms {
namespace {

/// Appends values to bytes.
struct Writer {
  std::string bytes{};

  template <class Value>
  void operator()(Value& value) {
    append_bytes(bytes, value);
  }
};

/// Takes the values again, in the same order.
struct Reader {
  ByteReader bytes;

  template <class Value>
  void operator()(Value& value) {
    value = bytes.take<Value>();
  }
};

template <class Visitor>
void visit_pose(Visitor& v, Eigen::Isometry3d& pose) {
  for (Eigen::Index i = 0; i < pose.matrix().size(); ++i) v(pose.matrix().data()[i]);
}

template <class Visitor>
void visit(Visitor& v, LoggedFrame& frame) {
  v(frame.stamp);
  v(frame.index);
  v(frame.session);
  Eigen::Isometry3d pose = frame.T_world_sensor.isometry();
  visit_pose(v, pose);
  frame.T_world_sensor = Transform<World, Sensor>(pose);
  v(frame.status);
  for (bool* flag : {&frame.keyframe, &frame.relocalized, &frame.is_searching, &frame.in_map}) {
    v(*flag);
  }
  v(frame.dynamic_share);
  v(frame.overruled_share);
  v(frame.implausible_masks);
  v(frame.read_ms);
  v(frame.interval_ms);
  for (double& ms : frame.stage_ms) v(ms);
  bool has_latency = frame.latency_ms.has_value();
  double latency_ms = frame.latency_ms.value_or(0.0);
  v(has_latency);
  v(latency_ms);
  if (has_latency) frame.latency_ms = latency_ms;
}

template <class Visitor>
void visit(Visitor& v, ObjectBox& box) {
  v(box.id);
  v(box.object_class);
  visit_pose(v, box.T_world_box);
  for (Eigen::Index i = 0; i < box.size.size(); ++i) v(box.size[i]);
  for (Eigen::Index i = 0; i < box.velocity.size(); ++i) v(box.velocity[i]);
  v(box.moving);
  v(box.score);
  v(box.visible);
}

template <class Visitor>
void visit(Visitor& v, ObjectFrame& frame) {
  v(frame.stamp);
  std::uint64_t count = frame.objects.size();
  v(count);
  frame.objects.resize(count);
  for (ObjectBox& box : frame.objects) visit(v, box);
}

template <class Record>
std::string encoded(Record record) {
  Writer writer;
  visit(writer, record);
  return std::move(writer.bytes);
}

template <class Record>
std::vector<Record> decoded(const DiskBuffer& buffer, std::size_t count) {
  const std::string bytes = buffer.read();
  Reader reader{ByteReader(bytes, "the frames of the run")};
  std::vector<Record> records(count);
  for (Record& record : records) visit(reader, record);
  return records;
}

}  // namespace

double LoggedFrame::stages_ms() const {
  return std::accumulate(stage_ms.begin(), stage_ms.end(), read_ms);
}

void FrameLog::add(const LoggedFrame& frame) {
  frames_.append(encoded(frame));
  if (size_++ == 0) first_ = frame;
  last_ = frame;
}

std::vector<LoggedFrame> FrameLog::read() const {
  return decoded<LoggedFrame>(frames_, size_);
}

void ObjectLog::add(const ObjectFrame& frame) {
  objects_.append(encoded(frame));
  ++size_;
}

ObjectHistory ObjectLog::read() const {
  return decoded<ObjectFrame>(objects_, size_);
}

}  // namespace mms
