#pragma once

#include <cstddef>
#include <string>
#include <string_view>

struct ddsi_sertype;
struct ddsi_serdata;

namespace mms {

// Samples of Cyclone DDS that are the bytes on the wire: mms/ros/wire.hpp encodes and decodes
// them, as in recordings. The types of rmw_cyclonedds and cyclonedds-cxx use the same interface.

/// A type without key by its DDS name, as "sensor_msgs::msg::dds_::Image_". The topic created with
/// it owns it.
ddsi_sertype* make_raw_type(const std::string& name);

/// A sample of `size` bytes, to be filled in at `data`, which begin with the encapsulation header.
/// Writing it takes over its ownership.
struct RawSample {
  ddsi_serdata* sample;
  std::byte* data;
};
RawSample make_raw_sample(const ddsi_sertype* type, std::size_t size);

/// The bytes of a sample that was taken from a reader of such a type.
std::string_view bytes_of(const ddsi_serdata* sample);

void release(ddsi_serdata* sample);

}  // namespace mms
