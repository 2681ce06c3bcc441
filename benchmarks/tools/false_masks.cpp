// Adds false masks to a recording: person-shaped and blob-shaped ones in bursts, as from a network
// that is wrong. usage: mms_false_masks RECORDING [SEED]
// Reads rgb/ and masks/ of the recording and writes masks/ anew; the same seed gives the same ones.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "mms/core/error.hpp"
#include "mms/core/image.hpp"
#include "mms/core/random_stream.hpp"
#include "mms/io/image/image_io.hpp"
#include "mms/io/image/picture_files.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;

/// [-]: share of the frames with a false mask.
constexpr double kShare = 0.2;
/// [frames]: longest burst.
constexpr std::size_t kLongestBurst = 15;
/// [frames]: at the start of the recording all have one, when the filter knows nothing yet.
constexpr std::size_t kFirstFrames = 5;
/// [-]: share of the image that a mask covers.
constexpr float kSmallest = 0.1F;
constexpr float kLargest = 0.6F;
/// Value of the pixels: a person, but never one instance with a true one beside it.
constexpr std::uint8_t kFalsePerson = 3;

struct Ellipse {
  float x, y, rx, ry;  ///< [px]

  bool contains(float u, float v) const { return std::hypot((u - x) / rx, (v - y) / ry) <= 1.0F; }
};

using Shape = std::vector<Ellipse>;

/// Head, torso and legs of a person of height 1 around the origin.
Shape person() {
  return {{0.0F, -0.42F, 0.07F, 0.085F},
          {0.0F, -0.15F, 0.15F, 0.22F},
          {-0.07F, 0.24F, 0.07F, 0.26F},
          {0.07F, 0.24F, 0.07F, 0.26F}};
}

Shape blob(RandomStream& random) {
  Shape shape;
  for (int i = 0; i < 4; ++i) {
    shape.push_back({random.between(-0.25F, 0.25F), random.between(-0.25F, 0.25F),
                     random.between(0.15F, 0.4F), random.between(0.15F, 0.4F)});
  }
  return shape;
}

Image<std::uint8_t> draw(const Shape& shape, float x, float y, float size, int width, int height) {
  Image<std::uint8_t> drawn(width, height);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const float a = (static_cast<float>(u) - x) / size;
      const float b = (static_cast<float>(v) - y) / size;
      const auto here = [&](const Ellipse& part) { return part.contains(a, b); };
      drawn(u, v) = std::any_of(shape.begin(), shape.end(), here) ? 1 : 0;
    }
  }
  return drawn;
}

float share(const Image<std::uint8_t>& drawn) {
  const auto covered = std::count(drawn.pixels().begin(), drawn.pixels().end(), 1);
  return static_cast<float>(covered) / static_cast<float>(drawn.size());
}

/// A shape that moves slowly through the image and covers a given share of it at first.
class Burst {
 public:
  Burst(RandomStream& random, int width, int height)
      : shape_(random.chance(0.5F) ? person() : blob(random)), width_(width), height_(height) {
    x_ = random.between(0.25F, 0.75F) * static_cast<float>(width);
    y_ = random.between(0.35F, 0.65F) * static_cast<float>(height);
    dx_ = random.between(-0.01F, 0.01F) * static_cast<float>(width);
    dy_ = random.between(-0.005F, 0.005F) * static_cast<float>(width);
    const float wanted = random.between(kSmallest, kLargest);
    size_ = 0.2F * static_cast<float>(height);
    // A blob with a gap at its center never covers all.
    const float largest = 20.0F * static_cast<float>(width);
    while (size_ < largest && share(draw(shape_, x_, y_, size_, width, height)) < wanted) {
      size_ *= 1.05F;
    }
  }

  Image<std::uint8_t> next() {
    x_ += dx_;
    y_ += dy_;
    return draw(shape_, x_, y_, size_, width_, height_);
  }

 private:
  Shape shape_;
  int width_, height_;
  float x_, y_, dx_, dy_, size_;
};

/// Length of the burst that begins at each frame, 0 for none; together `kShare` of the frames.
std::vector<std::size_t> plan_bursts(RandomStream& random, std::size_t frames) {
  std::vector<std::size_t> length(frames, 0);
  std::vector<bool> taken(frames, false);
  auto left = static_cast<std::ptrdiff_t>(kShare * static_cast<double>(frames));
  const auto place = [&](std::size_t begin, std::size_t count) {
    const std::size_t end = std::min(begin + count, frames);
    for (std::size_t i = begin; i < end; ++i) {
      if (taken[i]) return;
    }
    std::fill(taken.begin() + static_cast<std::ptrdiff_t>(begin),
              taken.begin() + static_cast<std::ptrdiff_t>(end), true);
    length[begin] = end - begin;
    left -= static_cast<std::ptrdiff_t>(end - begin);
  };
  place(0, kFirstFrames);
  while (left > 0) {
    const std::size_t most = std::min(kLongestBurst, static_cast<std::size_t>(left));
    place(random.below(frames), 1 + random.below(most));
  }
  return length;
}

void add_false_masks(const fs::path& recording, std::uint64_t seed) {
  RandomStream random(seed);
  const std::vector<fs::path> pictures = list_pictures(recording / "rgb");
  if (pictures.empty()) throw DataError(recording.string(), "has no pictures in rgb/");
  const std::vector<std::size_t> bursts = plan_bursts(random, pictures.size());
  fs::create_directories(recording / "masks");
  std::size_t burst_end = 0;
  std::vector<Burst> burst;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const fs::path file = recording / "masks" / pictures[i].filename().replace_extension(".png");
    const Image<Rgb> picture = read_color(pictures[i]);
    if (bursts[i] > 0) {
      burst = {Burst(random, picture.width(), picture.height())};
      burst_end = i + bursts[i];
    }
    Image<std::uint8_t> mask =
        fs::exists(file) ? read_mask(file) : Image<std::uint8_t>(picture.width(), picture.height());
    if (i < burst_end) {
      const Image<std::uint8_t> drawn = burst.front().next();
      for (std::size_t k = 0; k < mask.size(); ++k) {
        if (drawn[k] != 0 && mask[k] == 0) mask[k] = kFalsePerson;
      }
    }
    write_png(file, mask);
  }
}

}  // namespace
}  // namespace mms

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    std::cerr << "usage: mms_false_masks RECORDING [SEED]\n";
    return 2;
  }
  try {
    mms::add_false_masks(argv[1], argc > 2 ? std::stoull(argv[2]) : 1);
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
