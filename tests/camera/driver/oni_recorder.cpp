// Records the frames of the first camera with OpenNI2's own recorder, until the camera is
// unplugged. usage: oni_recorder FILE.oni

#include <OpenNI.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <thread>

namespace {

using openni::OpenNI;

class Unplugged final : public OpenNI::DeviceDisconnectedListener {
 public:
  void onDeviceDisconnected(const openni::DeviceInfo*) override { value = true; }
  std::atomic<bool> value = false;
};

bool check(openni::Status status, const char* what) {
  if (status != openni::STATUS_OK)
    std::fprintf(stderr, "%s: %s\n", what, OpenNI::getExtendedError());
  return status == openni::STATUS_OK;
}

bool record(const char* file) {
  Unplugged unplugged;
  OpenNI::addDeviceDisconnectedListener(&unplugged);
  openni::Device device;
  openni::VideoStream color;
  openni::VideoStream depth;
  openni::Recorder recorder;
  if (!check(device.open(openni::ANY_DEVICE), "device")) return false;
  if (!check(color.create(device, openni::SENSOR_COLOR), "color")) return false;
  if (!check(depth.create(device, openni::SENSOR_DEPTH), "depth")) return false;
  color.setMirroringEnabled(false);
  depth.setMirroringEnabled(false);
  if (!check(recorder.create(file), "recorder")) return false;
  if (!check(recorder.attach(color), "color")) return false;
  if (!check(recorder.attach(depth), "depth")) return false;
  if (!check(recorder.start(), "recorder")) return false;
  if (!check(color.start(), "color") || !check(depth.start(), "depth")) return false;
  while (!unplugged.value) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  recorder.stop();
  recorder.destroy();
  color.stop();
  depth.stop();
  OpenNI::removeDeviceDisconnectedListener(&unplugged);
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 || !check(OpenNI::initialize(), "OpenNI2")) return 1;
  const bool recorded = record(argv[1]);
  OpenNI::shutdown();
  return recorded ? 0 : 1;
}
