#include "apps/mms/console/training_progress.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "apps/mms/console/warnings.hpp"

namespace mms {
namespace {

constexpr std::size_t kShownFaults = 20;  // lines; left_out.txt has all

void show_left_out(const std::vector<std::string>& messages) {
  const std::size_t shown = std::min(messages.size(), kShownFaults);
  print_warnings({messages.begin(), messages.begin() + static_cast<std::ptrdiff_t>(shown)});
  fmt::print(stderr, "left out: {} {}, see left_out.txt\n", messages.size(),
             messages.size() == 1 ? "image or annotation" : "images and annotations");
}

}  // namespace

void TrainingProgress::show(const TrainingEvent& event) {
  if (event.kind == TrainingEvent::Kind::kLoading) {
    loading_.show(event.done, event.total);
    if (event.done < event.total) return;
    loading_.finish();
    training_.emplace("image");  // its clock starts here
    return;
  }
  if (event.kind == TrainingEvent::Kind::kLeftOut) {
    show_left_out(event.left_out);
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
