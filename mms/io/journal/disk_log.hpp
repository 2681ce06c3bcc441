#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "mms/core/object_box.hpp"
#include "mms/core/transform.hpp"
#include "mms/io/journal/byte_reader.hpp"
#include "mms/io/text/disk_buffer.hpp"

namespace mms {

/// Appends the fields of a record to bytes.
struct FieldWriter {
  std::string bytes{};  ///< of all fields so far

  /// Appends a field.
  template <class Value>
  void operator()(Value& value) {
    append_bytes(bytes, value);
  }
};

/// Takes them again, in the same order.
struct FieldReader {
  ByteReader bytes;  ///< of the fields that are left

  /// Sets a field.
  template <class Value>
  void operator()(Value& value) {
    value = bytes.take<Value>();
  }
};

// Each kind of record has a function `visit_fields(visitor, record)` that passes its fields to a
// visitor, one of the two above.

template <class Visitor, int kRows, int kColumns>
void visit_fields(Visitor& v, Eigen::Matrix<double, kRows, kColumns>& matrix) {
  for (Eigen::Index i = 0; i < matrix.size(); ++i) v(matrix.data()[i]);
}

template <class Visitor, class To, class From>
void visit_fields(Visitor& v, Transform<To, From>& pose) {
  Eigen::Isometry3d isometry = pose.isometry();
  visit_fields(v, isometry.matrix());
  pose = Transform<To, From>(isometry);
}

template <class Visitor>
void visit_fields(Visitor& v, ObjectBox& box) {
  v(box.id);
  v(box.object_class);
  visit_fields(v, box.T_world_box.matrix());
  visit_fields(v, box.size);
  visit_fields(v, box.velocity);
  v(box.moving);
  v(box.score);
  v(box.visible);
}

/// @param visit_one  visits an element
template <class Visitor, class Value, class VisitOne>
void visit_all(Visitor& v, std::vector<Value>& values, const VisitOne& visit_one) {
  std::uint64_t count = values.size();
  v(count);
  values.resize(count);
  for (Value& value : values) visit_one(value);
}

template <class Visitor>
void visit_fields(Visitor& v, ObjectFrame& frame) {
  v(frame.stamp);
  visit_all(v, frame.objects, [&](ObjectBox& box) { visit_fields(v, box); });
}

/// The records of a long run, on disk, so that they do not fill the memory.
template <class Record>
class DiskLog {
 public:
  /// @param folder  for a temporary file; empty: all stays in memory
  explicit DiskLog(const std::filesystem::path& folder = {}) : bytes_(folder) {}

  /// Appends a record.
  void add(Record record) {
    FieldWriter writer;
    visit_fields(writer, record);
    begins_.push_back(bytes_.size());
    bytes_.append(writer.bytes);
  }

  std::size_t size() const { return begins_.size(); }  ///< records

  /// All records. @throws FileError if they cannot be read
  std::vector<Record> read() const { return read(0, size()); }

  /// The records in [first, last), fewer if there are not as many. @throws as `read`
  std::vector<Record> read(std::size_t first, std::size_t last) const {
    last = std::min(last, size());
    if (first >= last) return {};
    const std::size_t end = last < size() ? begins_[last] : bytes_.size();
    const std::string bytes = bytes_.read(begins_[first], end);
    FieldReader reader{ByteReader(bytes, "the records of the run")};
    std::vector<Record> records(last - first);
    for (Record& record : records) visit_fields(reader, record);
    return records;
  }

 private:
  DiskBuffer bytes_;
  std::vector<std::size_t> begins_;  ///< of each record [B]
};

}  // namespace mms
