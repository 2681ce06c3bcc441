#include "mms/training/data/training_config.hpp"

#include <array>
#include <string_view>

namespace mms {
namespace {

constexpr Range kChance = {0.0, 1.0};
constexpr int kMany = 1'000'000'000;

}  // namespace

void TrainingData::visit(ConfigVisitor& v) {
  v.text({"annotations", "", "COCO file; none: images without objects"}, annotations);
  v.text({"images", "", "folder of the images; none: that of the annotations"}, images);
  v.text({"split", "", "use only images of this split; none: all"}, split);
  v.text({"containing", "", "use only images with an object of this class; none: all"}, containing);
  v.integer({"limit", "", "use only the first N images; 0: all"}, limit, {0, kMany});
  v.number({"repeat", "", "frequency of an image relative to the other sets"}, repeat,
           {0.0, 1000.0});
}

void AugmentationConfig::visit(ConfigVisitor& v) {
  v.number({"scale_min", "", "smallest scale, relative to the size that fits the network's input"},
           scale_min, {0.05, 4.0});
  v.number({"scale_max", "", "largest scale; larger images are cropped"}, scale_max, {0.05, 4.0});
  v.number({"flip", "", "probability of mirroring left and right"}, flip, kChance);
  v.number({"portrait", "", "probability of a portrait batch"}, portrait, kChance);
  v.number({"copy_paste", "", "probability of pasting objects of another image"}, copy_paste,
           kChance);
  v.number({"color", "", "probability of a change of brightness, contrast, saturation and hue"},
           color, kChance);
  v.number({"blur", "", "probability of motion blur"}, blur, kChance);
  v.number({"blur_length", "px", "longest motion blur"}, blur_length, {1.0, 64.0});
  v.number({"noise", "", "probability of sensor noise"}, noise, kChance);
  v.number({"grey", "", "probability of a gray image"}, grey, kChance);
  v.number({"roll", "", "probability of a rotation in the image plane"}, roll, kChance);
  v.number({"roll_max", "deg", "largest rotation"}, roll_max, {0.0, 180.0});
  v.number({"exposure", "", "probability of a dark or overexposed image"}, exposure, kChance);
  v.number({"image_shapes", "", "probability of a batch in the shape of one of the images"},
           image_shapes, kChance);
}

void ScheduleConfig::visit(ConfigVisitor& v) {
  constexpr std::array<std::string_view, 2> kOptimizers = {"sgd", "adamw"};
  constexpr std::array<std::string_view, 3> kTrained = {"all", "head", "kernels"};
  v.enumeration({"optimizer", "", "optimizer"}, optimizer, kOptimizers);
  v.integer({"images", "", "images in total"}, images, {1, kMany});
  v.integer({"batch", "", "images per step"}, batch, {1, 1024});
  v.number({"learning_rate", "", "largest learning rate"}, learning_rate, {0.0, 10.0});
  v.number({"backbone_factor", "", "factor of the learning rate of the pretrained part"},
           backbone_factor, {0.0, 10.0});
  v.number({"momentum", "", "of SGD"}, momentum, {0.0, 0.9999});
  v.number({"weight_decay", "", "weight decay"}, weight_decay, {0.0, 1.0});
  v.integer({"warm_up", "steps",
             "steps of linear warm-up from 1 % of the rate, at most a quarter of all steps"},
            warm_up, {0, kMany});
  v.number({"first_drop", "", "share of the steps after which the rate falls to a tenth"},
           first_drop, {0.0, 1.0});
  v.number({"second_drop", "", "share of the steps after which it falls again"}, second_drop,
           {0.0, 1.0});
  v.number({"clip_norm", "", "largest L2 norm of the gradient"}, clip_norm, {1e-3, 1e6});
  v.number({"ema", "", "decay of the averaged weights, which are the result"}, ema, {0.0, 0.99999});
  v.integer({"frozen_stages", "", "frozen stages of the backbone; 0: none"}, frozen_stages, {0, 4});
  v.integer({"kept_statistics", "", "stages with frozen batch norm statistics"}, kept_statistics,
            {0, 4});
  v.enumeration({"trained", "", "layers to train; kernels: the convolution that predicts them"},
                trained, kTrained);
  v.integer({"mask_pairs", "",
             "largest number of pairs of cell and object per image whose masks are learned"},
            mask_pairs, {1, 10000});
  v.number({"mask_weight", "", "weight of the mask loss relative to the category loss"},
           mask_weight, {0.0, 100.0});
}

void TrainingConfig::visit(ConfigVisitor& v) {
  v.group({"network", "", "architecture"}, network);
  v.text({"initial_backbone", "", "ImageNet weights with torchvision's names; none: random"},
         initial_backbone);
  v.text({"initial_weights", "",
          "initial weights file, also of a network without SAC, RFP or window; none: no weights"},
         initial_weights);
  v.list({"data", "", "sets of training images"}, data);
  v.list({"validation", "", "sets for measuring AP"}, validation);
  v.integer({"validation_images", "", "largest number per set"}, validation_images, {1, kMany});
  v.integer({"validation_every", "", "images between two validations"}, validation_every,
            {1, kMany});
  v.integer({"checkpoint_every", "", "images between two checkpoints"}, checkpoint_every,
            {1, kMany});
  v.group({"augmentation", "", "augmentation of the training images"}, augmentation);
  v.group({"schedule", "", "optimization schedule"}, schedule);
  v.boolean({"half_precision", "", "convolutions in bfloat16 if the device supports it"},
            half_precision);
  v.boolean({"use_cuda", "", "use a GPU if available"}, use_cuda);
  v.integer({"cache_side", "px", "largest side of images in memory"}, cache_side, {64, 4096});
  v.integer({"loader_threads", "", "threads that prepare images; 0: one per core"}, loader_threads,
            {0, 256});
  v.integer({"seed", "", "seed of all random numbers"}, seed, {0, kMany});
}

}  // namespace mms
