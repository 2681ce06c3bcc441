#include "interfaces/ros1/src/remote_image.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "mms/ros/image_messages.hpp"

namespace mms {

msg::CompressedImage remote_image(const msg::Header& header, const Image<Rgb>& image, int width,
                                  int quality) {
  if (image.width() <= width) return compressed_message(header, image, quality);
  Image<Rgb> small(width, std::max(1, image.height() * width / image.width()));
  const cv::Mat from(image.height(), image.width(), CV_8UC3, const_cast<Rgb*>(image.row(0)));
  cv::Mat to(small.height(), small.width(), CV_8UC3, small.row(0));
  cv::resize(from, to, to.size(), 0.0, 0.0, cv::INTER_AREA);
  return compressed_message(header, small, quality);
}

}  // namespace mms
