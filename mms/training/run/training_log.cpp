#include "mms/training/run/training_log.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "mms/core/error.hpp"
#include "mms/io/text/atomic_file.hpp"
#include "mms/io/text/files.hpp"

namespace mms {
namespace {

using nlohmann::json;

double number_or_nan(const json& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

LossPoint loss_point(const json& entry) {
  return {entry.at("images"), entry.at("loss"), entry.at("category_loss"), entry.at("mask_loss"),
          entry.at("learning_rate")};
}

ApPoint ap_point(const json& entry) {
  return {entry.at("images"), entry.at("set"), entry.at("category"), number_or_nan(entry.at("AP")),
          number_or_nan(entry.at("AP50"))};
}

}  // namespace

void TrainingLog::rewind(int images) {
  std::erase_if(losses, [&](const LossPoint& point) { return point.images > images; });
  std::erase_if(aps, [&](const ApPoint& point) { return point.images > images; });
}

TrainingLog read_training_log(const std::filesystem::path& path) {
  try {
    const json root = json::parse(read_file(path));
    TrainingLog log;
    log.seconds = root.at("seconds");
    for (const json& entry : root.at("losses")) log.losses.push_back(loss_point(entry));
    for (const json& entry : root.at("aps")) log.aps.push_back(ap_point(entry));
    return log;
  } catch (const json::exception& error) {
    throw DataError(path.string(), std::string("is not a training log: ") + error.what());
  }
}

void write_training_log(const std::filesystem::path& path, const TrainingLog& log) {
  json losses = json::array();
  for (const LossPoint& point : log.losses) {
    losses.push_back({{"images", point.images},
                      {"loss", point.loss},
                      {"category_loss", point.category_loss},
                      {"mask_loss", point.mask_loss},
                      {"learning_rate", point.learning_rate}});
  }
  json aps = json::array();
  for (const ApPoint& point : log.aps) {
    aps.push_back({{"images", point.images},
                   {"set", point.set},
                   {"category", point.category},
                   {"AP", point.ap},
                   {"AP50", point.ap50}});
  }
  const json root = {{"seconds", log.seconds}, {"losses", losses}, {"aps", aps}};
  write_file(path, root.dump(1));
}

}  // namespace mms
