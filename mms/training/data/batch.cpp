#include "mms/training/data/batch.hpp"

#include <torch/cuda.h>

#include "mms/core/hash_noise.hpp"
#include "mms/geometry/parallel.hpp"
#include "mms/segmentation/solo/prepared_image.hpp"
#include "mms/segmentation/solo/resize.hpp"
#include "mms/training/data/augmentation.hpp"

namespace mms {
namespace {

struct Canvas {
  int width = 0;   ///< [px]
  int height = 0;  ///< [px]
};

/// Size of the network's input: that of a random image at inference, or landscape or portrait;
/// equal for all images of a batch.
Canvas canvas_of(const SampleStore& store, const TrainingConfig& config, RandomStream& random) {
  const double shapes = config.augmentation.image_shapes;
  if (shapes > 0.0 && random.chance(static_cast<float>(shapes))) {
    const Sample& like = store.draw(random);
    const double scale =
        fitting_scale(like.width, like.height, config.network.long_side, config.network.short_side);
    return {padded_length(scaled_length(like.width, scale)),
            padded_length(scaled_length(like.height, scale))};
  }
  const int wide = padded_length(config.network.long_side);
  const int high = padded_length(config.network.short_side);
  const bool upright = random.chance(static_cast<float>(config.augmentation.portrait));
  return upright ? Canvas{high, wide} : Canvas{wide, high};
}

Sample augmented(const SampleStore& store, const TrainingConfig& config, const Canvas& canvas,
                 RandomStream& random) {
  const AugmentationConfig& changes = config.augmentation;
  Sample sample = jittered(store.draw(random), canvas.width, canvas.height, changes, random);
  if (random.chance(static_cast<float>(changes.copy_paste))) {
    const Sample other = jittered(store.draw(random), canvas.width, canvas.height, changes, random);
    paste_objects(sample, other, random);
  }
  change_colors(sample, changes, random);
  return sample;
}

}  // namespace

bool uses_cuda(const TrainingConfig& config) {
  return config.use_cuda && torch::cuda::is_available();
}

Batch make_batch(const SampleStore& store, const TrainingConfig& config, int number,
                 const BatchPart& part) {
  const auto seed =
      hash_of(static_cast<std::uint64_t>(config.seed), static_cast<std::uint64_t>(number));
  RandomStream random(seed);
  const Canvas canvas = canvas_of(store, config, random);
  const int images = config.schedule.batch / part.parts;
  const auto first = static_cast<std::size_t>(part.number * images);
  const auto count = static_cast<std::size_t>(images);
  Batch batch;
  batch.targets.resize(count);
  // Pinned memory is copied to a GPU in the background.
  batch.images = torch::zeros({images, 3, canvas.height, canvas.width},
                              torch::TensorOptions().pinned_memory(uses_cuda(config)));
  float* planes = batch.images.data_ptr<float>();
  const std::size_t image_size =
      3 * static_cast<std::size_t>(canvas.width) * static_cast<std::size_t>(canvas.height);
  parallel_chunks(count, 1, [&](std::size_t i, std::size_t) {
    RandomStream own(hash_of(seed, first + i + 1));
    const Sample sample = augmented(store, config, canvas, own);
    normalise(sample.image, sample.width, sample.height, canvas.width, canvas.height,
              planes + i * image_size);
    batch.targets[i] = assign_targets(sample, config.network.head);
  });
  return batch;
}

}  // namespace mms
