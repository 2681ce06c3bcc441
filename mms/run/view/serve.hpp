#pragma once

#include <memory>
#include <string>

#include "mms/run/record/run_options.hpp"
#include "mms/server/http/server.hpp"

namespace mms {

/// Starts to serve a scene.
/// @param port_hint  how to choose another port, for the error if it is in use
/// @param background  whether its threads have low priority
/// @throws DataError if the address or port cannot be used.
std::unique_ptr<ViewerServer> serve(const ViewOptions& options, std::shared_ptr<Scene> scene,
                                    const std::string& port_hint, bool background);

}  // namespace mms
