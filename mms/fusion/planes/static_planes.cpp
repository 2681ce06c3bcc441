#include "mms/fusion/planes/static_planes.hpp"

#include <cmath>
#include <cstddef>

namespace mms {
namespace {

PlaneSearch plane_search(const PlaneRemoval& config) {
  PlaneSearch search;
  search.min_area = static_cast<float>(config.min_area);
  search.min_extent = static_cast<float>(config.min_extent);
  search.min_share = static_cast<float>(config.min_share);
  search.max_normal_angle = static_cast<float>(config.max_normal_angle);
  search.max_planes = config.max_planes;
  return search;
}

}  // namespace

std::vector<Plane> find_static_planes(const std::vector<PlaneSample>& samples,
                                      const std::vector<std::uint8_t>& masked,
                                      const PlaneRemoval& config) {
  const float min_cosine = static_cast<float>(std::cos(config.max_normal_angle));
  std::vector<Plane> planes = find_planes(samples, plane_search(config));
  std::erase_if(planes, [&](const Plane& plane) {
    float area = 0.0F;
    float masked_area = 0.0F;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (!is_on_plane(samples[i], plane, min_cosine)) continue;
      area += samples[i].area;
      masked_area += masked[i] != 0 ? samples[i].area : 0.0F;
    }
    return masked_area > static_cast<float>(config.max_masked_share) * area;
  });
  return planes;
}

}  // namespace mms
