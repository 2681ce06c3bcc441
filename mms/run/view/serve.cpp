#include "mms/run/view/serve.hpp"

#include <utility>

namespace mms {

std::unique_ptr<ViewerServer> serve(const ViewOptions& options, std::shared_ptr<Scene> scene,
                                    const std::string& port_hint, bool background) {
  ServerOptions server_options;
  server_options.address = options.bind;
  server_options.port = options.port;
  server_options.port_hint = port_hint;
  server_options.version = MMS_VERSION;
  server_options.background = background;
  return std::make_unique<ViewerServer>(server_options, std::move(scene));
}

}  // namespace mms
