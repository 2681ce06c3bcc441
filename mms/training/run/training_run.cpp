#include "mms/training/run/training_run.hpp"

#include <ATen/Parallel.h>

#include <cmath>
#include <set>
#include <utility>

#include "mms/core/error.hpp"
#include "mms/core/segmentation.hpp"
#include "mms/io/config/config_yaml.hpp"
#include "mms/io/text/atomic_file.hpp"
#include "mms/io/text/files.hpp"
#include "mms/io/weights/safetensors.hpp"
#include "mms/segmentation/network/inference.hpp"
#include "mms/segmentation/weights/imagenet_backbone.hpp"
#include "mms/segmentation/weights/int8_weights.hpp"
#include "mms/segmentation/weights/model.hpp"
#include "mms/segmentation/weights/weight_transfer.hpp"
#include "mms/training/data/batch_loader.hpp"
#include "mms/training/run/schedule.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kStepsPerPoint = 25;  // of the loss curve

void check(const TrainingConfig& config, const ProcessPlace& place) {
  if (config.data.empty()) {
    throw ConfigError("data", "is empty", "add at least one set of images");
  }
  if (config.network.classes != kObjectClassCount) {
    throw ConfigError("network.classes", "is " + std::to_string(config.network.classes) +
                                             ", expected " + std::to_string(kObjectClassCount) +
                                             ": person and agv");
  }
  if (config.schedule.batch % place.size != 0) {
    throw ConfigError("schedule.batch", "is " + std::to_string(config.schedule.batch) +
                                            ", expected a multiple of the number of processes, " +
                                            std::to_string(place.size));
  }
}

}  // namespace

std::vector<std::string> training_classes() {
  std::vector<std::string> names;
  for (int i = 0; i < kObjectClassCount; ++i) {
    names.emplace_back(to_string(static_cast<ObjectClass>(i)));
  }
  return names;
}

TrainingRun::TrainingRun(const TrainingConfig& config, const fs::path& folder, int threads,
                         const ProcessPlace& place, const std::function<bool()>& stop)
    : config_(config),
      folder_(folder),
      config_text_(dump_config(config)),
      group_([&] {
        check(config, place);
        return ProcessGroup(place, stop);
      }()),
      trainer_([&] {
        at::set_num_threads(threads > 0 ? threads : cores_of(place));
        torch::manual_seed(static_cast<std::uint64_t>(config.seed));
        return Trainer(config, group_);
      }()),
      stop_(stop) {
  if (group_.is_first()) {
    lock_.emplace(folder);
    for (const TrainingData& set : config.validation) {
      validation_.emplace_back(set, training_classes(), config.validation_images,
                               validation_faults_);
    }
    start_or_resume();
  }
  share_start();
  first_image_ = images_seen();
}

void TrainingRun::on_event(std::function<bool(const TrainingEvent&)> callback) {
  callback_ = std::move(callback);
}

void TrainingRun::start_or_resume() {
  const fs::path settings = folder_ / "config.yaml";
  const fs::path checkpoint = folder_ / "checkpoint.pt";
  if (fs::exists(checkpoint)) {
    if (read_file(settings) != config_text_) {
      throw ConfigError(folder_.string(), "has a training with other settings",
                        "choose another folder, or compare with its config.yaml");
    }
    trainer_.load(checkpoint);
    log_ = read_training_log(folder_ / "log.json");
    log_.rewind(images_seen());
  } else {
    initialise();
    write_file(settings, config_text_);
  }
}

void TrainingRun::share_start() {
  if (group_.broadcast(config_text_) != config_text_) {
    throw ConfigError("the settings", "are not those of the first process",
                      "start all processes with the same file");
  }
  trainer_.share_state();
}

void TrainingRun::check_same_data(std::size_t images) {
  const std::string own = std::to_string(images);
  const std::string first = group_.broadcast(own);
  if (first == own) return;
  throw DataError("data", "this process can use " + own + " images, the first one " + first,
                  "give all processes the same files");
}

void TrainingRun::initialise() {
  if (!config_.initial_backbone.empty()) {
    const std::string& path = config_.initial_backbone;
    trainer_.initialise(imagenet_backbone(read_safetensors(path), config_.network, path).weights,
                        path);
  }
  if (!config_.initial_weights.empty()) {
    const std::string& path = config_.initial_weights;
    const Weights given = from_bytes(read_safetensors(path), path);
    trainer_.initialise(grown_to(config_.network, given), path);
  }
}

int TrainingRun::images_seen() const {
  return trainer_.steps() * config_.schedule.batch;
}

/// Whether the last step passed a multiple of `images`.
bool TrainingRun::every(int images) const {
  return images_seen() / images != (images_seen() - config_.schedule.batch) / images;
}

bool TrainingRun::tell(const TrainingEvent& event) {
  return !callback_ || callback_(event);
}

/// Whether this is true in all processes.
bool TrainingRun::all_of(bool here) {
  return group_.sum(torch::tensor(here ? 0 : 1)).item<int>() == 0;
}

/// Several processes end together, at the next event.
bool TrainingRun::stopped() const {
  return group_.size() == 1 && stop_ && stop_();
}

/// Of the steps since the last point.
LossPoint TrainingRun::mean_of_recent() {
  const torch::Tensor mean =
      group_.sum(torch::stack(recent_).mean(0).to(torch::kCPU, torch::kDouble));
  LossPoint point;
  point.loss = mean[0].item<double>();
  point.category_loss = mean[1].item<double>();
  point.mask_loss = mean[2].item<double>();
  return point;
}

void TrainingRun::check_finite() {
  if (recent_.empty() || std::isfinite(mean_of_recent().loss)) return;
  throw DataError("step " + std::to_string(trainer_.steps()), "the loss is not finite",
                  "lower schedule.learning_rate; the last checkpoint is unchanged");
}

void TrainingRun::tell_left_out(const CocoFaults& of_training) {
  TrainingEvent event;
  event.kind = TrainingEvent::Kind::kLeftOut;
  std::set<std::string> known;  // a file may be part of several sets
  for (const auto* messages :
       {&of_training.images, &of_training.annotations, &std::as_const(validation_faults_.images),
        &std::as_const(validation_faults_.annotations)}) {
    for (const std::string& message : *messages) {
      if (known.insert(message).second) event.left_out.push_back(message);
    }
  }
  fs::remove(left_out_path());
  if (event.left_out.empty()) return;
  std::string text;
  for (const std::string& message : event.left_out) text += message + "\n";
  write_file(left_out_path(), text);
  tell(event);
}

bool TrainingRun::train() {
  const SampleStore store(
      config_.data, training_classes(), config_.cache_side, [this](int done, int total) {
        tell({.kind = TrainingEvent::Kind::kLoading, .done = done, .total = total, .fresh = done});
      });
  if (group_.is_first()) tell_left_out(store.faults());
  check_same_data(store.size());
  clock_ = std::chrono::steady_clock::now();
  const int last = total_steps(config_.schedule);
  BatchLoader loader(store, config_, trainer_.steps(), last,
                     {.number = group_.place().rank, .parts = group_.size()});
  while (const std::optional<Batch> batch = loader.next()) {
    if (!after_step(trainer_.step(*batch))) {
      checkpoint();
      return false;
    }
  }
  validate();
  checkpoint();
  return true;
}

bool TrainingRun::after_step(const torch::Tensor& losses) {
  recent_.push_back(losses);
  bool going = true;
  if (recent_.size() >= kStepsPerPoint) going = log_losses();
  if (every(config_.validation_every)) going = validate() && going;
  if (every(config_.checkpoint_every)) checkpoint();
  return going && !stopped();
}

bool TrainingRun::log_losses() {
  check_finite();
  LossPoint point = mean_of_recent();
  point.images = images_seen();
  point.learning_rate = learning_rate_at(config_.schedule, trainer_.steps());
  recent_.clear();
  log_.losses.push_back(point);
  return all_of(tell({.kind = TrainingEvent::Kind::kStep,
                      .done = images_seen(),
                      .total = total_steps(config_.schedule) * config_.schedule.batch,
                      .fresh = images_seen() - first_image_,
                      .loss = point}));
}

bool TrainingRun::validate() {
  check_finite();
  TrainingEvent event;
  event.kind = TrainingEvent::Kind::kValidation;
  event.done = images_seen();
  for (const ValidationSet& set : validation_) {
    const SegmentationErrors errors = set.measure([this](const Image<Rgb>& image) {
      return network::detect(trainer_.average(), image, DecoderConfig());
    });
    for (const ClassScores& scores : errors.per_class) {
      event.aps.push_back(
          {images_seen(), set.name(), scores.name, scores.scores.ap, scores.scores.ap50});
    }
  }
  // A finished training is validated again if it is restarted.
  std::erase_if(log_.aps, [&](const ApPoint& point) { return point.images == images_seen(); });
  log_.aps.insert(log_.aps.end(), event.aps.begin(), event.aps.end());
  if (group_.is_first()) write_results();
  return all_of(tell(event));
}

void TrainingRun::checkpoint() {
  check_finite();
  if (!group_.is_first()) return;
  const auto now = std::chrono::steady_clock::now();
  log_.seconds += std::chrono::duration<double>(now - clock_).count();
  clock_ = now;
  // The log first: entries beyond the checkpoint are removed when the training is continued.
  write_training_log(folder_ / "log.json", log_);
  trainer_.save(folder_ / "checkpoint.pt");
  write_results();
  write_training_report(report_path(), folder_.filename().string(), log_, config_text_);
}

void TrainingRun::write_results() {
  const SegmentationModel model = {config_.network, training_classes(),
                                   network::to_weights(*trainer_.average())};
  write_safetensors(weights_path(), pack_model(model), TensorType::kFloat16);
}

}  // namespace mms
