#include "mms/simulation/sensors/mask_errors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "mms/core/hash_noise.hpp"

namespace mms {
namespace {

constexpr float kWave = 24.0F;     // wavelength of the erosion's variation [px of 640]
constexpr int kFramesOfShape = 4;  // frames during which the boundary's shape changes
constexpr double kMinWidth =
    5.0;  // objects narrower than this multiple of the erosion are eroded less
constexpr float kSpillMin = 4.0F;   // [px of 640]
constexpr float kSpillMax = 10.0F;  // [px of 640]
enum Kind : std::uint64_t { kMissed = 1, kLostPart, kSpill, kBoundary };

/// State of a pixel in the window around an object.
enum State : std::uint8_t { kFree, kOwn, kEroded, kCutOff, kOthers };

/// Hash of the error period that contains frame `index`, if any. Time is divided into blocks with
/// one period each, anywhere but on the last frame, so that `share` of the frames are in periods of
/// `mean` frames on average, and any frame is evaluated without the previous ones.
std::optional<std::uint64_t> spell_at(double share, double mean, std::uint64_t key, int index) {
  share = std::min(share, 0.95);
  if (!(share > 0.0)) return std::nullopt;
  const double at_least = std::ceil(1.0 / (1.0 - share) - 1e-9);
  const auto block = static_cast<std::int64_t>(std::max(std::round(mean / share), at_least));
  const std::int64_t time = index + static_cast<std::int64_t>(hash_of(key) >> 1) % block;
  const std::uint64_t hash = hash_of(key, static_cast<std::uint64_t>(time / block));
  const auto draw = [&](std::uint64_t i) {
    return static_cast<double>(uniform_of(hash_of(hash, i)));
  };
  const double center = share * static_cast<double>(block);
  const double longest =
      std::min(std::max(2.0 * center - 1.0, center), static_cast<double>(block - 1));
  const double drawn = center + (longest - center) * (2.0 * draw(1) - 1.0);
  const auto length = static_cast<std::int64_t>(drawn + draw(2));
  const auto start = static_cast<std::int64_t>(draw(3) * static_cast<double>(block - length));
  const std::int64_t inside = time % block - start;
  return inside >= 0 && inside < length ? std::optional(hash) : std::nullopt;
}

/// Pixels in [x0, x1) x [y0, y1).
struct Box {
  int x0 = 1 << 30;
  int y0 = 1 << 30;
  int x1 = 0;
  int y1 = 0;

  bool empty() const { return x1 <= x0; }
  int shorter_side() const { return std::min(x1 - x0, y1 - y0); }
  void add(int x, int y) {
    *this = {std::min(x0, x), std::min(y0, y), std::max(x1, x + 1), std::max(y1, y + 1)};
  }
};

std::array<Box, 256> boxes_of(const Image<std::uint8_t>& instances) {
  std::array<Box, 256> boxes;
  for (int y = 0; y < instances.height(); ++y) {
    for (int x = 0; x < instances.width(); ++x) {
      if (const std::uint8_t id = instances(x, y); id != 0) boxes[id].add(x, y);
    }
  }
  return boxes;
}

/// Mask of one object in a window of the image, with errors.
class ObjectMask {
 public:
  ObjectMask(const Image<std::uint8_t>& instances, std::uint8_t id, const Box& box,
             const MaskErrorConfig& config)
      : box_(box), scale_(static_cast<float>(instances.width()) / 640.0F) {
    const double full_erosion = config.erosion * static_cast<double>(scale_);
    const double limit = box.shorter_side() / kMinWidth;
    const double strength = full_erosion > limit ? limit / full_erosion : 1.0;
    erosion_ = static_cast<float>(strength * full_erosion);
    jitter_ = static_cast<float>(strength * config.boundary_jitter) * scale_;
    const int margin = static_cast<int>(std::ceil(erosion_ + 1.5F * kSpillMax * scale_)) + 1;
    x0_ = std::max(box.x0 - margin, 0);
    y0_ = std::max(box.y0 - margin, 0);
    state_ = Image<std::uint8_t>(std::min(box.x1 + margin, instances.width()) - x0_,
                                 std::min(box.y1 + margin, instances.height()) - y0_);
    for (int y = 0; y < state_.height(); ++y) {
      for (int x = 0; x < state_.width(); ++x) {
        const std::uint8_t here = instances(x + x0_, y + y0_);
        state_(x, y) = here == id ? kOwn : here == 0 ? kFree : kOthers;
      }
    }
  }

  /// Erodes the boundary irregularly; its shape changes over several frames.
  void erode(std::uint64_t key, int index) {
    if (!(erosion_ + jitter_ > 0.0F)) return;
    const int limit = static_cast<int>(std::ceil(erosion_ + jitter_)) + 1;
    const Image<int> rows = rows_to_boundary(limit);
    const auto shape = static_cast<std::uint64_t>(index / kFramesOfShape);
    const std::array seeds{hash_of(key, shape), hash_of(key, shape + 1)};
    const float share = static_cast<float>(index % kFramesOfShape) / kFramesOfShape;
    for (int y = 0; y < state_.height(); ++y) {
      for (int x = 0; x < state_.width(); ++x) {
        if (state_(x, y) != kOwn) continue;
        const float inside = distance_to_boundary(rows, x, y, limit);
        if (inside >= static_cast<float>(limit)) continue;
        const float noise = (1.0F - share) * wave(seeds[0], x, y) + share * wave(seeds[1], x, y);
        if (inside < erosion_ + jitter_ * noise) state_(x, y) = kEroded;
      }
    }
  }

  /// Removes the part beyond a line: the lower part, one side, or any part.
  void cut(std::uint64_t hash) {
    constexpr float kPi = std::numbers::pi_v<float>;
    const float way = uniform_of(hash_of(hash, 11));
    float angle = 2.0F * kPi * uniform_of(hash_of(hash, 12));  // any part
    if (way < 0.5F)
      angle = 0.5F * kPi + 0.1F * (angle - kPi);  // legs
    else if (way < 0.75F)
      angle = (way < 0.625F ? kPi : 0.0F) + 0.1F * (angle - kPi);  // a side
    const float nx = std::cos(angle);
    const float ny = std::sin(angle);
    const float extent = 0.5F * (std::abs(nx) * static_cast<float>(box_.x1 - box_.x0) +
                                 std::abs(ny) * static_cast<float>(box_.y1 - box_.y0));
    const float offset = extent * (0.05F + 0.45F * uniform_of(hash_of(hash, 13)));
    for (int y = 0; y < state_.height(); ++y) {
      for (int x = 0; x < state_.width(); ++x) {
        const float dx = static_cast<float>(x + x0_) - 0.5F * static_cast<float>(box_.x0 + box_.x1);
        const float dy = static_cast<float>(y + y0_) - 0.5F * static_cast<float>(box_.y0 + box_.y1);
        const bool own = state_(x, y) == kOwn || state_(x, y) == kEroded;
        if (own && nx * dx + ny * dy > offset) state_(x, y) = kCutOff;
      }
    }
  }

  /// Shifts the mask to one side, over the eroded boundary and some background pixels.
  void spill(std::uint64_t hash) {
    const float angle = 2.0F * std::numbers::pi_v<float> * uniform_of(hash_of(hash, 21));
    const float reach =
        scale_ * (kSpillMin + (kSpillMax - kSpillMin) * uniform_of(hash_of(hash, 22)));
    const Image<std::uint8_t> before = state_;
    for (int y = 0; y < state_.height(); ++y) {
      for (int x = 0; x < state_.width(); ++x) {
        if (before(x, y) != kFree && before(x, y) != kEroded) continue;
        const float far = erosion_ + reach * (1.0F + 0.5F * wave(hash, x, y));
        if (near_own(before, x, y, std::cos(angle), std::sin(angle), far)) state_(x, y) = kOwn;
      }
    }
  }

  void write(Image<std::uint8_t>& labels, std::uint8_t label) const {
    for (int y = 0; y < state_.height(); ++y) {
      for (int x = 0; x < state_.width(); ++x) {
        if (state_(x, y) == kOwn) labels(x + x0_, y + y0_) = label;
      }
    }
  }

 private:
  /// Noise in [-1, 1] that moves with the object.
  float wave(std::uint64_t seed, int x, int y) const {
    const float u = static_cast<float>(x + x0_ - box_.x0) / (kWave * scale_);
    const float v = static_cast<float>(y + y0_ - box_.y0) / (kWave * scale_);
    return value_noise(static_cast<std::uint32_t>(seed >> 32), u, v);
  }

  /// Rows from each pixel to the nearest one outside the object, at most `limit` + 1. Beyond the
  /// image the object is continued.
  Image<int> rows_to_boundary(int limit) const {
    Image<int> rows(state_.width(), state_.height());
    for (int x = 0; x < state_.width(); ++x) {
      int count = limit + 1;
      const auto step = [&](int y) {
        count = state_(x, y) == kOwn ? std::min(count + 1, limit + 1) : 0;
        return count;
      };
      for (int y = 0; y < state_.height(); ++y) rows(x, y) = step(y);
      count = limit + 1;
      for (int y = state_.height() - 1; y >= 0; --y) rows(x, y) = std::min(rows(x, y), step(y));
    }
    return rows;
  }

  /// Distance [px] of a pixel's center to the boundary, which is half a pixel before the nearest
  /// pixel outside the object; at least `limit` if farther.
  float distance_to_boundary(const Image<int>& rows, int x, int y, int limit) const {
    int nearest2 = (limit + 1) * (limit + 1);
    const int last = std::min(x + limit, state_.width() - 1);
    for (int other = std::max(x - limit, 0); other <= last; ++other) {
      const int down = rows(other, y);
      nearest2 = std::min(nearest2, (other - x) * (other - x) + down * down);
    }
    return std::sqrt(static_cast<float>(nearest2)) - 0.5F;
  }

  static bool near_own(const Image<std::uint8_t>& state, int x, int y, float dx, float dy,
                       float reach) {
    for (float s = 1.0F; s <= reach; s += 1.0F) {
      const int from_x = x - static_cast<int>(std::lround(s * dx));
      const int from_y = y - static_cast<int>(std::lround(s * dy));
      if (state.contains(from_x, from_y) && state(from_x, from_y) == kOwn) return true;
    }
    return false;
  }

  Box box_;
  float scale_;           // factor for images wider than 640 px
  float erosion_ = 0.0F;  // [px]
  float jitter_ = 0.0F;   // [px]
  int x0_ = 0;            // left column of the window
  int y0_ = 0;            // top row of the window
  Image<std::uint8_t> state_;
};

/// Writes the erroneous mask of one object.
void segment(const Image<std::uint8_t>& instances, std::uint8_t id, const Box& box,
             std::uint8_t label, const MaskErrorConfig& config, std::uint64_t key, int index,
             Image<std::uint8_t>& labels) {
  const auto spell = [&](double share, Kind kind) {
    return spell_at(share, config.spell, hash_of(key, kind), index);
  };
  if (spell(config.missed, kMissed)) return;
  ObjectMask mask(instances, id, box, config);
  mask.erode(hash_of(key, kBoundary), index);
  if (const auto hash = spell(config.lost_parts, kLostPart)) mask.cut(*hash);
  if (const auto hash = spell(config.spill, kSpill)) mask.spill(*hash);
  mask.write(labels, label);
}

/// Labels without errors.
Image<std::uint8_t> exact_masks(const Image<std::uint8_t>& instances,
                                std::span<const ObjectClass> classes) {
  std::array<std::uint8_t, 256> labels{};
  for (std::size_t id = 0; id < std::min<std::size_t>(classes.size(), 255); ++id) {
    labels[id + 1] = static_cast<std::uint8_t>(1 + static_cast<int>(classes[id]));
  }
  Image<std::uint8_t> result(instances.width(), instances.height());
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = labels[instances[i]];
  return result;
}

}  // namespace

void MaskErrorConfig::visit(ConfigVisitor& v) {
  v.boolean({"enabled", "", "give masks with errors instead of exact ones"}, enabled);
  v.number({"missed", "", "share of an object's frames without mask"}, missed, {0.0, 0.9});
  v.number({"spell", "frames", "mean duration of each error"}, spell, {1.0, 1000.0});
  v.number({"erosion", "px", "mean erosion of the boundary, for images 640 px wide"}, erosion,
           {0.0, 50.0});
  v.number(
      {"boundary_jitter", "px", "variation of the erosion, for images 640 px wide", "raggedness"},
      boundary_jitter, {0.0, 50.0});
  v.number({"lost_parts", "", "share of an object's frames in which its mask lacks a part"},
           lost_parts, {0.0, 0.9});
  v.number({"spill", "", "share of an object's frames in which its mask covers background"}, spill,
           {0.0, 0.9});
}

Image<std::uint8_t> imperfect_masks(const Image<std::uint8_t>& instances,
                                    std::span<const ObjectClass> classes,
                                    const MaskErrorConfig& config, std::uint64_t seed, int index) {
  if (!config.enabled) return exact_masks(instances, classes);
  Image<std::uint8_t> labels(instances.width(), instances.height());
  const std::array<Box, 256> boxes = boxes_of(instances);
  for (std::size_t id = 0; id < std::min<std::size_t>(classes.size(), 255); ++id) {
    if (boxes[id + 1].empty()) continue;
    segment(instances, static_cast<std::uint8_t>(id + 1), boxes[id + 1],
            static_cast<std::uint8_t>(1 + static_cast<int>(classes[id])), config, hash_of(seed, id),
            index, labels);
  }
  return labels;
}

}  // namespace mms
