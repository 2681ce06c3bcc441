#pragma once

#include <filesystem>
#include <string>

#include "mms/io/image/coco_io.hpp"
#include "mms/io/image/image_io.hpp"
#include "mms/training/data/training_config.hpp"

namespace mms::testing {

/// Images with a bright vertical bar (person) or a dark horizontal one (agv) on grey.
inline void write_bars(const std::filesystem::path& folder, int images) {
  CocoDataset dataset;
  dataset.categories = {{1, "person"}, {2, "agv"}};
  std::filesystem::create_directories(folder / "images");
  for (int i = 0; i < images; ++i) {
    const bool person = i % 2 == 0;
    const int width = person ? 20 : 50;
    const int height = person ? 50 : 20;
    const int x = 8 + (i * 37) % (112 - width);
    const int y = 6 + (i * 23) % (84 - height);
    Image<Rgb> image(128, 96, Rgb{120, 120, 120});
    for (int v = y; v < y + height; ++v) {
      for (int u = x; u < x + width; ++u) image(u, v) = person ? Rgb{250, 60, 60} : Rgb{10, 90, 20};
    }
    const std::string name = std::to_string(i) + ".png";
    write_png(folder / "images" / name, image);
    dataset.images.push_back({.id = i, .file_name = name, .width = 128, .height = 96});
    dataset.annotations.push_back(
        coco_annotation(i + 1, i, person ? 1 : 2,
                        encode_rle(Image<std::uint8_t>(width, height, 1), x, y, 128, 96)));
  }
  write_coco(folder / "annotations.json", dataset);
}

/// A small network with random weights that learns them in minutes, on the CPU.
inline TrainingConfig small_training(const std::filesystem::path& data, int images) {
  TrainingConfig config;
  config.network.long_side = 128;
  config.network.short_side = 96;
  config.network.head.object_scale = 20;
  config.network.head.grid_density = 0.4;
  config.data = {{.annotations = (data / "annotations.json").string()}};
  config.validation = config.data;
  config.half_precision = false;
  config.use_cuda = false;
  config.augmentation = {.scale_min = 1.0,
                         .scale_max = 1.0,
                         .flip = 0.5,
                         .portrait = 0,
                         .copy_paste = 0,
                         .color = 0,
                         .blur = 0,
                         .noise = 0,
                         .grey = 0};
  config.schedule = {.optimizer = Optimizer::kAdamW,
                     .images = images,
                     .batch = 4,
                     .learning_rate = 2e-3,
                     .warm_up = 5,
                     .ema = 0.9,
                     .frozen_stages = 0,
                     .kept_statistics = 0};
  return config;
}

}  // namespace mms::testing
