#include "mms/ros2/raw_sample.hpp"

#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_sertype.h>
#include <dds/ddsi/q_radmin.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>

namespace mms {
namespace {

constexpr std::size_t kAlignment = 4;  // DDSI sends whole words

struct Bytes : ddsi_serdata {
  std::size_t size = 0;
  std::unique_ptr<std::byte[]> data;
};

const Bytes* raw(const ddsi_serdata* sample) {
  return static_cast<const Bytes*>(sample);
}

Bytes* make(const ddsi_sertype* type, ddsi_serdata_kind kind, std::size_t size) {
  auto* bytes = new Bytes();
  ddsi_serdata_init(bytes, type, kind);
  const std::size_t padded = (size + kAlignment - 1) / kAlignment * kAlignment;
  bytes->size = size;
  bytes->data.reset(new std::byte[padded]);  // not zeroed: it is filled in next
  std::fill(bytes->data.get() + size, bytes->data.get() + padded, std::byte{0});
  return bytes;
}

bool same_key(const ddsi_serdata*, const ddsi_serdata*) {
  return true;  // there are no keys
}

std::uint32_t size_of(const ddsi_serdata* sample) {
  return static_cast<std::uint32_t>(raw(sample)->size);
}

/// Fragments may overlap.
ddsi_serdata* from_fragments(const ddsi_sertype* type, ddsi_serdata_kind kind,
                             const nn_rdata* fragment, std::size_t size) {
  Bytes* bytes = make(type, kind, size);
  std::size_t done = 0;
  for (; fragment != nullptr; fragment = fragment->nextfrag) {
    const std::size_t end = std::min<std::size_t>(fragment->maxp1, size);
    if (end <= done || fragment->min > done) continue;
    const unsigned char* payload =
        NN_RMSG_PAYLOADOFF(fragment->rmsg, NN_RDATA_PAYLOAD_OFF(fragment));
    std::memcpy(bytes->data.get() + done, payload + (done - fragment->min), end - done);
    done = end;
  }
  std::fill(bytes->data.get() + done, bytes->data.get() + size, std::byte{0});
  return bytes;
}

ddsi_serdata* from_vectors(const ddsi_sertype* type, ddsi_serdata_kind kind,
                           ddsrt_msg_iovlen_t count, const ddsrt_iovec_t* vectors,
                           std::size_t size) {
  Bytes* bytes = make(type, kind, size);
  std::size_t done = 0;
  for (ddsrt_msg_iovlen_t i = 0; i < count && done < size; ++i) {
    const std::size_t part = std::min<std::size_t>(vectors[i].iov_len, size - done);
    std::memcpy(bytes->data.get() + done, vectors[i].iov_base, part);
    done += part;
  }
  std::fill(bytes->data.get() + done, bytes->data.get() + size, std::byte{0});
  return bytes;
}

ddsi_serdata* from_key_hash(const ddsi_sertype* type, const ddsi_keyhash*) {
  return make(type, SDK_KEY, 0);
}

void copy_out(const ddsi_serdata* sample, std::size_t offset, std::size_t size, void* to) {
  std::memcpy(to, raw(sample)->data.get() + offset, size);
}

ddsi_serdata* reference(const ddsi_serdata* sample, std::size_t offset, std::size_t size,
                        ddsrt_iovec_t* to) {
  to->iov_base = raw(sample)->data.get() + offset;
  to->iov_len = size;
  return ddsi_serdata_ref(sample);
}

void end_reference(ddsi_serdata* sample, const ddsrt_iovec_t*) {
  ddsi_serdata_unref(sample);
}

ddsi_serdata* untyped(const ddsi_serdata* sample) {
  Bytes* key = make(sample->type, SDK_KEY, 0);
  key->type = nullptr;
  return key;
}

void free_sample(ddsi_serdata* sample) {
  delete static_cast<Bytes*>(sample);
}

std::size_t print(const ddsi_sertype*, const ddsi_serdata* sample, char* text, std::size_t size) {
  return static_cast<std::size_t>(std::snprintf(text, size, "%zu bytes", raw(sample)->size));
}

void no_key_hash(const ddsi_serdata*, ddsi_keyhash* hash, bool) {
  std::memset(hash, 0, sizeof *hash);
}

ddsi_serdata_ops sample_operations() {
  ddsi_serdata_ops ops{};
  ops.eqkey = same_key;
  ops.get_size = size_of;
  ops.from_ser = from_fragments;
  ops.from_ser_iov = from_vectors;
  ops.from_keyhash = from_key_hash;
  // Samples are only written and taken as bytes.
  ops.from_sample = [](const ddsi_sertype*, ddsi_serdata_kind, const void*) -> ddsi_serdata* {
    return nullptr;
  };
  ops.to_ser = copy_out;
  ops.to_ser_ref = reference;
  ops.to_ser_unref = end_reference;
  ops.to_sample = [](const ddsi_serdata*, void*, void**, void*) { return false; };
  ops.to_untyped = untyped;
  ops.untyped_to_sample = [](const ddsi_sertype*, const ddsi_serdata*, void*, void**, void*) {
    return false;
  };
  ops.free = free_sample;
  ops.print = print;
  ops.get_keyhash = no_key_hash;
  return ops;
}

void free_type(ddsi_sertype* type) {
  ddsi_sertype_fini(type);
  std::free(type);
}

ddsi_sertype_ops type_operations() {
  ddsi_sertype_ops ops{};
  ops.version = ddsi_sertype_v0;
  ops.free = free_type;
  ops.zero_samples = [](const ddsi_sertype*, void*, std::size_t) {};
  ops.realloc_samples = [](void** pointers, const ddsi_sertype*, void*, std::size_t,
                           std::size_t count) { std::fill_n(pointers, count, nullptr); };
  ops.free_samples = [](const ddsi_sertype*, void**, std::size_t, dds_free_op_t) {};
  ops.equal = [](const ddsi_sertype*, const ddsi_sertype*) { return true; };  // names are compared
  ops.hash = [](const ddsi_sertype*) -> std::uint32_t { return 0; };
  return ops;
}

}  // namespace

ddsi_sertype* make_raw_type(const std::string& name) {
  static const ddsi_serdata_ops kSamples = sample_operations();
  static const ddsi_sertype_ops kTypes = type_operations();
  auto* type = static_cast<ddsi_sertype*>(std::calloc(1, sizeof(ddsi_sertype)));
  if (type == nullptr) throw std::bad_alloc();
  ddsi_sertype_init_flags(type, name.c_str(), &kTypes, &kSamples,
                          DDSI_SERTYPE_FLAG_TOPICKIND_NO_KEY);
  type->allowed_data_representation = DDS_DATA_REPRESENTATION_FLAG_XCDR1;
  return type;
}

RawSample make_raw_sample(const ddsi_sertype* type, std::size_t size) {
  Bytes* bytes = make(type, SDK_DATA, size);
  return {bytes, bytes->data.get()};
}

std::string_view bytes_of(const ddsi_serdata* sample) {
  return {reinterpret_cast<const char*>(raw(sample)->data.get()), raw(sample)->size};
}

void release(ddsi_serdata* sample) {
  ddsi_serdata_unref(sample);
}

}  // namespace mms
