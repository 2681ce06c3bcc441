#include "mms/dataset/capture/capture_sensor.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "mms/core/error.hpp"
#include "mms/dataset/capture/ouster_decoder.hpp"
#include "mms/dataset/capture/velodyne_decoder.hpp"
#include "mms/io/text/files.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kProbed = 5000;  // datagrams in which a sensor must be found

fs::path beside(const fs::path& capture, const char* ending) {
  fs::path file = capture;
  file.replace_extension();
  file += ending;
  return file;
}

/// The metadata of an Ouster; empty for none.
fs::path find_metadata(const fs::path& capture) {
  for (const char* ending : {".json", "_0.json"}) {
    if (fs::exists(beside(capture, ending))) return beside(capture, ending);
  }
  const fs::path folder = capture.has_parent_path() ? capture.parent_path() : fs::path(".");
  std::vector<std::string> found;
  for (const std::string& name : list_folder(folder)) {
    if (name.ends_with(".json")) found.push_back(name);
  }
  return found.size() == 1 ? folder / found[0] : fs::path();
}

std::unique_ptr<PacketDecoder> make_velodyne(std::string_view packet, const fs::path& capture) {
  if (!is_hdl64_packet(packet)) return make_velodyne_decoder(packet, {}, capture.string());
  const fs::path file = beside(capture, ".yaml");
  if (fs::exists(file)) {
    return make_velodyne_decoder(packet, read_velodyne_calibration(file), capture.string());
  }
  throw DataError(capture.string(), "is of an HDL-64E, each of which has its own corrections",
                  "add them as " + file.filename().string() +
                      ", made of its db.xml by gen_calibration.py of ROS's Velodyne driver");
}

/// "1206 bytes (12), 512 bytes (3)", the most frequent first.
std::string sizes_text(const std::map<std::size_t, std::size_t>& counts) {
  constexpr std::size_t kShown = 3;
  std::vector<std::pair<std::size_t, std::size_t>> order;  // count, size
  for (const auto& [size, count] : counts) order.emplace_back(count, size);
  std::sort(order.rbegin(), order.rend());
  std::string text;
  for (std::size_t i = 0; i < std::min(kShown, order.size()); ++i) {
    text += (i == 0 ? "" : ", ") + std::to_string(order[i].second) + " bytes (" +
            std::to_string(order[i].first) + ")";
  }
  return text.empty() ? "no UDP datagrams" : "UDP datagrams of " + text;
}

/// The Ouster of a metadata file, or what is wrong with the file: it may be of another program.
struct OusterCandidate {
  fs::path metadata;
  std::unique_ptr<PacketDecoder> decoder;
  std::string fault;
};

OusterCandidate find_ouster(const fs::path& capture) {
  OusterCandidate candidate{find_metadata(capture), nullptr, ""};
  if (candidate.metadata.empty()) {
    candidate.fault = "an Ouster's needs its metadata, as " +
                      beside(capture, ".json").filename().string() + " beside it";
    return candidate;
  }
  try {
    candidate.decoder =
        make_ouster_decoder(read_ouster_metadata(candidate.metadata), candidate.metadata.string());
    candidate.fault = "is " + candidate.metadata.filename().string() + " of this recording?";
  } catch (const DataError& error) {
    candidate.fault = error.what();
  }
  return candidate;
}

}  // namespace

CaptureSensor find_capture_sensor(PacketCapture& capture, const fs::path& path) {
  OusterCandidate ouster = find_ouster(path);
  CaptureSensor sensor;
  std::map<std::size_t, std::size_t> sizes;
  for (std::size_t i = 0; i < kProbed && !sensor.decoder; ++i) {
    const auto datagram = capture.next();
    if (!datagram) break;
    ++sizes[datagram->payload.size()];
    sensor.address = datagram->source_address;
    sensor.port = datagram->destination_port;
    if (is_velodyne_packet(datagram->payload)) {
      sensor.decoder = make_velodyne(datagram->payload, path);
    } else if (ouster.decoder && ouster.decoder->is_data(datagram->payload)) {
      sensor.decoder = std::move(ouster.decoder);
    }
  }
  if (!sensor.decoder) {
    throw DataError(path.string(),
                    "has no data packets of a Velodyne or an Ouster, but " + sizes_text(sizes),
                    ouster.fault);
  }
  sensor.facts = sensor.decoder->facts();
  return sensor;
}

}  // namespace mms
