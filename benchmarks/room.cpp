#include "room.hpp"

#include "mms/simulation/simulated_room.hpp"

namespace mms {

const RoomRecording& room_recording() {
  static const RoomRecording recording = [] {
    RoomConfig config;
    config.frames = 60;
    const SimulatedRoom room(config);
    RoomRecording result;
    for (int i = 0; i < room.size(); ++i) {
      result.frames.push_back(room.render(i));
      result.truth.push_back(room.truth(i));
    }
    return result;
  }();
  return recording;
}

}  // namespace mms
