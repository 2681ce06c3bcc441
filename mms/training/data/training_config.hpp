#pragma once

#include <string>
#include <vector>

#include "mms/core/config.hpp"
#include "mms/segmentation/solo/network_config.hpp"

namespace mms {

/// One set of images to learn from.
struct TrainingData {
  std::string annotations{};  ///< COCO file; empty: images without any object
  std::string images{};       ///< folder of the images; empty: beside the annotations
  std::string split{};        ///< only images of this split; empty: all
  std::string containing{};   ///< only images with an object of this class; empty: all
  int limit = 0;              ///< only the first so many images; 0: all
  double repeat = 1.0;        ///< how often an image is drawn, relative to those of other sets

  void visit(ConfigVisitor& v);
};

/// Changes of the training images. Chances are per image.
struct AugmentationConfig {
  double scale_min = 0.5;    ///< of the size that just fits the network's input
  double scale_max = 1.6;    ///< larger ones are cropped
  double flip = 0.5;         ///< chance to mirror left and right
  double portrait = 0.15;    ///< chance of a batch to stand upright
  double copy_paste = 0.5;   ///< chance that objects of another image are pasted in
  double color = 0.8;        ///< chance of changed brightness, contrast, saturation, hue
  double blur = 0.2;         ///< chance of motion blur
  double blur_length = 8.0;  ///< longest [px]
  double noise = 0.3;        ///< chance of sensor noise
  double grey = 0.05;        ///< chance to lose its colours

  void visit(ConfigVisitor& v);
};

enum class Optimizer { kSgd, kAdamW };

/// How the weights are learned.
struct ScheduleConfig {
  Optimizer optimizer = Optimizer::kSgd;
  int images = 80000;            ///< to be seen in all
  int batch = 8;                 ///< images a step
  double learning_rate = 0.01;   ///< at its peak
  double backbone_factor = 1.0;  ///< learning rate of the pretrained part, relative
  double momentum = 0.9;         ///< of SGD
  double weight_decay = 1e-4;
  int warm_up = 500;  ///< steps in which the rate rises from a hundredth, at most a quarter of all
  double first_drop = 0.75;   ///< share of the steps after which the rate falls to a tenth
  double second_drop = 0.92;  ///< and again
  double clip_norm = 35.0;    ///< largest L2 norm of all gradients
  double ema = 0.999;         ///< of the averaged weights, which are those that are shipped
  int frozen_stages = 1;      ///< of the backbone keep their weights (0: all are learned)
  int kept_statistics = 3;    ///< stages whose batch norm keeps its statistics
  double mask_weight = 3.0;   ///< of the mask loss beside the category loss

  void visit(ConfigVisitor& v);
};

/// What `mms train` does.
struct TrainingConfig {
  NetworkConfig network;
  std::string initial_backbone;  ///< ImageNet weights, torchvision's names; empty: random
  std::string initial_weights;   ///< a weights file to go on from; empty: none
  std::vector<TrainingData> data;
  std::vector<TrainingData> validation;  ///< AP is measured on each
  int validation_images = 200;           ///< of each set, at most
  int validation_every = 10000;          ///< images seen between two measurements
  int checkpoint_every = 2000;           ///< images seen between two checkpoints
  AugmentationConfig augmentation;
  ScheduleConfig schedule;
  bool half_precision = true;  ///< convolutions in bfloat16 (CUDA, CPUs with AVX512-BF16)
  bool use_cuda = true;        ///< where there is one
  int cache_side = 480;        ///< images are kept in memory no longer than this [px]
  int loader_threads = 1;      ///< that prepare images beside the training; 0: one a core
  int seed = 1;

  void visit(ConfigVisitor& v);
};

}  // namespace mms
