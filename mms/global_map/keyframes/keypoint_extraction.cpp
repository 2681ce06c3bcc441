#include "mms/global_map/keyframes/keypoint_extraction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "mms/geometry/camera.hpp"
#include "mms/global_map/keyframes/opencv_descriptor.hpp"

namespace mms {
namespace {

/// [-]: keypoints of an image. Source: as MapClosures; a keyframe's descriptors take 16 kB.
constexpr std::size_t kMaxKeypoints = 500;

/// [-]: keypoints that are detected, before those without depth are left out and the rest is
/// spread. Source: three times as many leave enough in most cells.
constexpr int kDetected = 1500;

/// [-]: columns of the cells over which keypoints are spread. Source: initial choice.
constexpr int kColumns = 8;

/// [-]: rows of these cells. Source: squares, with `kColumns`.
constexpr int kRows = 6;

/// [-]: keypoints in a cell, at most. Source: a third of the 48 cells has room for all.
constexpr int kMaxInCell = 30;

/// [px]: boundary of the image without keypoints. Source: ORB's patch of 31 px.
constexpr int kBoundary = 31;

/// [-]: least contrast of a keypoint. Source: minThFAST of ORB-SLAM; the static part of a view full
/// of people has few strong ones.
constexpr int kMinContrast = 7;

/// [-]: differences of depth within a continuous surface, as a share of the depth.
/// Source: a surface at 70 degrees, across two points of the grid.
constexpr float kMaxStep = 0.03F;

cv::Mat gray_of(const Image<Rgb>& color) {
  const cv::Mat rgb(color.height(), color.width(), CV_8UC3,
                    const_cast<Rgb*>(color.pixels().data()));  // NOLINT: read only
  cv::Mat gray;
  cv::cvtColor(rgb, gray, cv::COLOR_RGB2GRAY);
  return gray;
}

/// Non-zero where a keypoint can have a point, of the image's size: without it, most keypoints of a
/// long aisle are beyond the range of the depth.
cv::Mat mask_of(const LabeledCloud& cloud, const cv::Mat& gray) {
  cv::Mat grid(cloud.height, cloud.width, CV_8U);
  for (std::size_t i = 0; i < cloud.labels.size(); ++i) {
    const bool masked = !cloud.dynamic_pixels.empty() && cloud.dynamic_pixels[i] != 0;
    grid.data[i] = cloud.labels[i] == PointLabel::kStatic && !masked ? 255 : 0;
  }
  cv::Mat mask;
  cv::resize(grid, mask, gray.size(), 0.0, 0.0, cv::INTER_NEAREST);
  return mask;
}

/// The grid of a cloud below an image.
class CloudGrid {
 public:
  CloudGrid(const LabeledCloud& cloud, const Image<Rgb>& color, const DepthNoise& noise)
      : cloud_(cloud),
        camera_(cloud.camera),
        noise_(noise),
        scale_(static_cast<double>(cloud.width) / color.width(),
               static_cast<double>(cloud.height) / color.height()) {}

  /// The static point at a pixel of the image; nothing on boundaries of objects.
  std::optional<Eigen::Vector3f> point_at(const cv::Point2f& pixel) const {
    const Eigen::Vector2d at((pixel.x + 0.5) * scale_.x() - 0.5,
                             (pixel.y + 0.5) * scale_.y() - 0.5);
    const auto x = static_cast<int>(std::lround(at.x()));
    const auto y = static_cast<int>(std::lround(at.y()));
    if (x < 1 || y < 1 || x + 1 >= cloud_.width || y + 1 >= cloud_.height) return std::nullopt;
    const float z = cloud_.points[cloud_.index(x, y)].z();
    const float step = std::max(kMaxStep * z, 3.0F * noise_.sigma(z));
    float sum = 0.0F;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const std::size_t i = cloud_.index(x + dx, y + dy);
        const bool masked = !cloud_.dynamic_pixels.empty() && cloud_.dynamic_pixels[i] != 0;
        if (cloud_.labels[i] != PointLabel::kStatic || masked) return std::nullopt;
        if (!(std::abs(cloud_.points[i].z() - z) <= step)) return std::nullopt;
        sum += cloud_.points[i].z();
      }
    }
    return Eigen::Vector3f(camera_.ray(at).cast<float>() * (sum / 9.0F));
  }

 private:
  const LabeledCloud& cloud_;
  CameraModel camera_;
  DepthNoise noise_;
  Eigen::Array2d scale_;
};

}  // namespace

ImageKeypoints extract_keypoints(const Image<Rgb>& color, const LabeledCloud& cloud,
                                 const DepthNoise& noise) {
  ImageKeypoints result;
  if (color.empty() || !cloud.organised()) return result;
  const cv::Mat gray = gray_of(color);
  const cv::Ptr<cv::ORB> orb = cv::ORB::create(kDetected, 1.2F, 8, kBoundary, 0, 2,
                                               cv::ORB::HARRIS_SCORE, kBoundary, kMinContrast);
  std::vector<cv::KeyPoint> detected;
  orb->detect(gray, detected, mask_of(cloud, gray));
  std::stable_sort(detected.begin(), detected.end(),
                   [](const auto& a, const auto& b) { return a.response > b.response; });
  const CloudGrid grid(cloud, color, noise);
  std::array<int, kColumns * kRows> in_cell{};
  std::vector<cv::KeyPoint> chosen;
  std::vector<Eigen::Vector3f> points;
  for (const cv::KeyPoint& keypoint : detected) {
    if (chosen.size() == kMaxKeypoints) break;
    const int column = static_cast<int>(keypoint.pt.x) * kColumns / color.width();
    const int row = static_cast<int>(keypoint.pt.y) * kRows / color.height();
    int& count = in_cell[static_cast<std::size_t>(row * kColumns + column)];
    if (count == kMaxInCell) continue;
    const auto point = grid.point_at(keypoint.pt);
    if (!point) continue;
    ++count;
    chosen.push_back(keypoint);
    chosen.back().class_id = static_cast<int>(points.size());
    points.push_back(*point);
  }
  cv::Mat descriptors;
  orb->compute(gray, chosen, descriptors);  // may drop keypoints
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    result.descriptors.push_back(descriptor_of(descriptors, static_cast<int>(i)));
    result.points.push_back(points[static_cast<std::size_t>(chosen[i].class_id)]);
    result.pixels.emplace_back(chosen[i].pt.x / static_cast<float>(color.width()),
                               chosen[i].pt.y / static_cast<float>(color.height()));
  }
  return result;
}

}  // namespace mms
