#pragma once

#include <string>
#include <vector>

#include "mms/core/config_visitor.hpp"
#include "mms/segmentation/solo/network_config.hpp"

namespace mms {

/// A set of training images.
struct TrainingData {
  std::string annotations{};  ///< COCO file; empty: images without objects
  std::string images{};       ///< folder of the images; empty: that of the annotations
  std::string split{};        ///< only images of this split; empty: all
  std::string containing{};   ///< only images with an object of this class; empty: all
  int limit = 0;              ///< only the first so many images; 0: all
  double repeat = 1.0;        ///< frequency of an image relative to other sets

  void visit(ConfigVisitor& v);
};

/// Augmentation of the training images. Probabilities are per image.
struct AugmentationConfig {
  double scale_min = 0.5;     ///< relative to the size that fits the network's input
  double scale_max = 1.6;     ///< larger images are cropped
  double flip = 0.5;          ///< probability of mirroring left and right
  double portrait = 0.15;     ///< probability of a portrait batch
  double copy_paste = 0.5;    ///< probability of pasting objects of another image
  double color = 0.8;         ///< probability of a change of brightness, contrast, saturation, hue
  double blur = 0.2;          ///< probability of motion blur
  double blur_length = 8.0;   ///< longest [px]
  double noise = 0.3;         ///< probability of sensor noise
  double grey = 0.05;         ///< probability of a gray image
  double roll = 0.0;          ///< probability of a rotation in the image plane
  double roll_max = 45.0;     ///< largest [deg]
  double exposure = 0.0;      ///< probability of a dark or overexposed image
  double image_shapes = 0.0;  ///< probability of a batch in the shape of one of the images

  void visit(ConfigVisitor& v);
};

enum class Optimizer { kSgd, kAdamW };

/// The layers that are trained.
enum class TrainedLayers {
  kAll,
  kHead,     ///< without backbone and feature pyramid
  kKernels,  ///< the convolution that predicts kernels and windows
};

/// Optimization schedule.
struct ScheduleConfig {
  Optimizer optimizer = Optimizer::kSgd;
  int images = 80000;            ///< in total
  int batch = 8;                 ///< images per step
  double learning_rate = 0.01;   ///< largest
  double backbone_factor = 1.0;  ///< factor of the learning rate of the pretrained part
  double momentum = 0.9;         ///< of SGD
  double weight_decay = 1e-4;
  int warm_up = 500;  ///< steps of linear warm-up from 1 % of the rate, at most a quarter of all
  double first_drop = 0.75;   ///< share of the steps after which the rate falls to a tenth
  double second_drop = 0.92;  ///< share after which it falls again
  double clip_norm = 35.0;    ///< largest L2 norm of the gradient
  double ema = 0.999;         ///< decay of the averaged weights, which are the result
  int frozen_stages = 1;      ///< frozen stages of the backbone; 0: none
  int kept_statistics = 3;    ///< stages with frozen batch norm statistics
  TrainedLayers trained = TrainedLayers::kAll;
  int mask_pairs = 200;      ///< pairs of cell and object per image whose masks are learned
  double mask_weight = 3.0;  ///< weight of the mask loss relative to the category loss

  void visit(ConfigVisitor& v);
};

/// Settings of `mms train`.
struct TrainingConfig {
  NetworkConfig network;
  std::string initial_backbone;  ///< ImageNet weights, torchvision's names; empty: random
  std::string initial_weights;   ///< initial weights file; empty: none
  std::vector<TrainingData> data;
  std::vector<TrainingData> validation;  ///< sets for measuring AP
  int validation_images = 200;           ///< largest number per set
  int validation_every = 10000;          ///< images between two validations
  int checkpoint_every = 2000;           ///< images between two checkpoints
  AugmentationConfig augmentation;
  ScheduleConfig schedule;
  bool half_precision = true;  ///< convolutions in bfloat16 (CUDA, CPUs with AVX512-BF16)
  bool use_cuda = true;        ///< if available
  int cache_side = 480;        ///< largest side of images in memory [px]
  int loader_threads = 1;      ///< threads that prepare images; 0: one per core
  int seed = 1;

  void visit(ConfigVisitor& v);
};

}  // namespace mms
