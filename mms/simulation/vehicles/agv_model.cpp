#include "mms/simulation/vehicles/agv_model.hpp"

#include "mms/simulation/vehicles/agv_kinds.hpp"

namespace mms {

std::unique_ptr<ArticulatedModel> make_agv(AgvKind kind, std::uint64_t seed) {
  switch (kind) {
    case AgvKind::kGrabbing:
      return make_grabbing_agv(seed);
    case AgvKind::kForklift:
      return make_forklift(seed);
    case AgvKind::kScanning:
      return make_scanning_agv(seed);
    case AgvKind::kPioneer:
      return make_pioneer(seed);
    case AgvKind::kTransport:
      break;
  }
  return make_transport_agv(seed);
}

}  // namespace mms
