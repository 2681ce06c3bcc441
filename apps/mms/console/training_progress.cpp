#include "apps/mms/console/training_progress.hpp"

#include <fmt/core.h>

#include <cmath>

namespace mms {

void TrainingProgress::show(const TrainingEvent& event) {
  if (event.kind == TrainingEvent::Kind::kLoading) {
    loading_.show(event.done, event.total);
    if (event.done == event.total) loading_.finish();
    return;
  }
  if (!training_) training_.emplace("image");
  if (event.kind == TrainingEvent::Kind::kStep) {
    training_->show(event.done, event.total, event.fresh,
                    fmt::format("loss {:.3f} (category {:.3f}, mask {:.3f})", event.loss.loss,
                                event.loss.category_loss, event.loss.mask_loss));
  } else {
    for (const ApPoint& point : event.aps) {
      if (std::isnan(point.ap)) continue;  // the set has no such object
      training_->say(fmt::format("after {} images, {}, {}: AP {:.3f}, AP50 {:.3f}", point.images,
                                 point.set, point.category, point.ap, point.ap50));
    }
  }
}

void TrainingProgress::finish() {
  if (training_) training_->finish();
}

}  // namespace mms
