#pragma once

#include <memory>
#include <string>

#include "mms/run/record/view_options.hpp"
#include "mms/server/http/server.hpp"

namespace mms {

/// Begins to serve a scene.
/// @param port_hint  how to choose another port, for the error when it is taken
/// @param background  whether its threads give way to all others
/// @throws DataError when the address or port cannot be listened at.
std::unique_ptr<ViewerServer> serve(const ViewOptions& options, std::shared_ptr<Scene> scene,
                                    const std::string& port_hint, bool background);

}  // namespace mms
