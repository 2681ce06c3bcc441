#pragma once

#include <string>
#include <vector>

namespace mms {

/// Names of COCO's 80 classes in the usual order.
const std::vector<std::string>& coco_classes();

}  // namespace mms
