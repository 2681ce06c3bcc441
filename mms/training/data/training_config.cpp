#include "mms/training/data/training_config.hpp"

#include <array>
#include <string_view>

namespace mms {
namespace {

constexpr Range kChance = {0.0, 1.0};
constexpr int kMany = 1'000'000'000;

}  // namespace

void TrainingData::visit(ConfigVisitor& v) {
  v.text({"annotations", "", "COCO file; none: images without any object"}, annotations);
  v.text({"images", "", "folder of the images; none: beside the annotations"}, images);
  v.text({"split", "", "only images of this split; none: all"}, split);
  v.text({"containing", "", "only images with an object of this class; none: all"}, containing);
  v.integer({"limit", "", "only the first so many images; 0: all"}, limit, {0, kMany});
  v.number({"repeat", "", "how often an image is drawn, relative to the other sets"}, repeat,
           {0.0, 1000.0});
}

void AugmentationConfig::visit(ConfigVisitor& v) {
  v.number({"scale_min", "", "of the size that just fits the network's input"}, scale_min,
           {0.05, 4.0});
  v.number({"scale_max", "", "larger images are cropped"}, scale_max, {0.05, 4.0});
  v.number({"flip", "", "chance to mirror left and right"}, flip, kChance);
  v.number({"portrait", "", "chance of a batch to stand upright"}, portrait, kChance);
  v.number({"copy_paste", "", "chance that objects of another image are pasted in"}, copy_paste,
           kChance);
  v.number({"color", "", "chance of changed brightness, contrast, saturation and hue"}, color,
           kChance);
  v.number({"blur", "", "chance of motion blur"}, blur, kChance);
  v.number({"blur_length", "px", "longest motion blur"}, blur_length, {1.0, 64.0});
  v.number({"noise", "", "chance of sensor noise"}, noise, kChance);
  v.number({"grey", "", "chance to lose the colours"}, grey, kChance);
}

void ScheduleConfig::visit(ConfigVisitor& v) {
  constexpr std::array<std::string_view, 2> kOptimizers = {"sgd", "adamw"};
  v.enumeration({"optimizer", "", "rule of the steps"}, optimizer, kOptimizers);
  v.integer({"images", "", "images to be seen in all"}, images, {1, kMany});
  v.integer({"batch", "", "images a step"}, batch, {1, 1024});
  v.number({"learning_rate", "", "at its peak"}, learning_rate, {0.0, 10.0});
  v.number({"backbone_factor", "", "learning rate of the pretrained part, relative"},
           backbone_factor, {0.0, 10.0});
  v.number({"momentum", "", "of sgd"}, momentum, {0.0, 0.9999});
  v.number({"weight_decay", "", "pull of the weights towards 0"}, weight_decay, {0.0, 1.0});
  v.integer(
      {"warm_up", "steps", "in which the rate rises from a hundredth, at most a quarter of all"},
      warm_up, {0, kMany});
  v.number({"first_drop", "", "share of the steps after which the rate falls to a tenth"},
           first_drop, {0.0, 1.0});
  v.number({"second_drop", "", "share of the steps after which it falls again"}, second_drop,
           {0.0, 1.0});
  v.number({"clip_norm", "", "largest L2 norm of all gradients"}, clip_norm, {1e-3, 1e6});
  v.number({"ema", "", "of the averaged weights, which are written"}, ema, {0.0, 0.99999});
  v.integer({"frozen_stages", "", "of the backbone that keep their weights; 0: none"},
            frozen_stages, {0, 4});
  v.integer({"kept_statistics", "", "stages whose batch norm keeps its statistics"},
            kept_statistics, {0, 4});
  v.number({"mask_weight", "", "of the mask loss beside the category loss"}, mask_weight,
           {0.0, 100.0});
}

void TrainingConfig::visit(ConfigVisitor& v) {
  v.group({"network", "", "architecture"}, network);
  v.text({"initial_backbone", "", "ImageNet weights with torchvision's names; none: random"},
         initial_backbone);
  v.text({"initial_weights", "",
          "weights file to go on from, also of a network without SAC or RFP; none: from the start"},
         initial_weights);
  v.list({"data", "", "sets of images to learn from"}, data);
  v.list({"validation", "", "sets that AP is measured on"}, validation);
  v.integer({"validation_images", "", "of each set, at most"}, validation_images, {1, kMany});
  v.integer({"validation_every", "", "images seen between two measurements"}, validation_every,
            {1, kMany});
  v.integer({"checkpoint_every", "", "images seen between two checkpoints"}, checkpoint_every,
            {1, kMany});
  v.group({"augmentation", "", "changes of the training images"}, augmentation);
  v.group({"schedule", "", "how the weights are learned"}, schedule);
  v.boolean({"half_precision", "", "convolutions in bfloat16 where the device computes in it"},
            half_precision);
  v.boolean({"use_cuda", "", "where there is a GPU"}, use_cuda);
  v.integer({"cache_side", "px", "images are kept in memory no longer than this"}, cache_side,
            {64, 4096});
  v.integer({"loader_threads", "", "that prepare images beside the training; 0: one a core"},
            loader_threads, {0, 256});
  v.integer({"seed", "", "of everything that is left to chance"}, seed, {0, kMany});
}

}  // namespace mms
