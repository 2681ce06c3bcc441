#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "mms/core/image.hpp"
#include "mms/localization/robot_body/depth_view.hpp"

namespace mms {

/// What two views show of each other from a relative pose. All arguments must outlive it.
class ViewComparison {
 public:
  using Seen = DepthView::Seen;

  /// Compared nodes.
  struct Votes {
    int same = 0;
    int other = 0;

    void add(Seen seen) {
      same += seen == Seen::kSame;
      other += seen == Seen::kOther;
    }
    int compared() const { return same + other; }
  };

  /// @param constant  not 0: nodes that are constant since the reference
  ViewComparison(const DepthView& reference, const DepthView& now,
                 const Image<std::uint8_t>& constant, const Eigen::Isometry3d& T_reference_now)
      : reference_(reference),
        now_(now),
        constant_(constant),
        T_reference_now_(T_reference_now.cast<float>()),
        T_now_reference_(T_reference_now.inverse().cast<float>()) {}

  /// What the other view shows at a point, as far as no constant nodes hide it.
  /// @param is_now  whether the point is of `now`, else of the reference
  Seen seen(const Eigen::Vector3f& point, bool is_now) const {
    return is_now ? reference_.at(T_reference_now_ * point, constant_)
                  : now_.at(T_now_reference_ * point, constant_);
  }

  /// The same for points of constant nodes themselves.
  Seen seen_constant(const Eigen::Vector3f& point, bool is_now) const {
    return is_now ? reference_.at(T_reference_now_ * point, {})
                  : now_.at(T_now_reference_ * point, {});
  }

  /// Calls visit(whether the node is constant, its point, whether it is of `now`) for the valid
  /// nodes of both views.
  template <class Visit>
  void for_each_node(const Visit& visit) const {
    for (int y = 0; y < constant_.height(); ++y) {
      for (int x = 0; x < constant_.width(); ++x) {
        const bool is_constant = constant_(x, y) != 0;
        if (now_.nodes()(x, y).is_valid()) visit(is_constant, now_.nodes()(x, y).point, true);
        if (reference_.nodes()(x, y).is_valid()) {
          visit(is_constant, reference_.nodes()(x, y).point, false);
        }
      }
    }
  }

 private:
  const DepthView& reference_;
  const DepthView& now_;
  const Image<std::uint8_t>& constant_;
  Eigen::Isometry3f T_reference_now_;
  Eigen::Isometry3f T_now_reference_;
};

}  // namespace mms
